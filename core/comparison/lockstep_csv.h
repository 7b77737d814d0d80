// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "core/comparison/lockstep_solver.h"
#include "core/io/output_file.h"

namespace trajlo {

/// Writes the records of a lockstep run as they come: `lockstep.csv` with a line per window and
/// variant, `iterations.csv` with a line per step. Members throw OutputError.
class LockstepCsvWriter {
 public:
  LockstepCsvWriter(const std::filesystem::path& folder,
                    const std::vector<SolverVariant>& variants);

  void Append(const LockstepRecord& record);
  void Close();

 private:
  const std::vector<SolverVariant>& variants_;
  OutputFile windows_, iterations_;
  bool is_first_ = true;
};

}  // namespace trajlo
