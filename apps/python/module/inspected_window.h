// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/config/config.h"
#include "core/graph/reweigh.h"
#include "core/graph/window_graph.h"

namespace trajlo::python {

/// A window as it was solved in a run, or once more with other weights. Immutable.
class InspectedWindow {
 public:
  /// `config`: that of the run.
  InspectedWindow(std::int64_t index, Window window, std::shared_ptr<const RunConfig> config,
                  SolveSummary summary = {})
      : index_(index),
        window_(std::move(window)),
        config_(std::move(config)),
        summary_(std::move(summary)),
        graph_(MakeWindowGraph(window_)) {}

  std::int64_t index() const { return index_; }
  const Window& window() const { return window_; }
  const WindowGraph& graph() const { return graph_; }
  const RunConfig& config() const { return *config_; }
  /// How it was solved once more; empty if it was not.
  const SolveSummary& summary() const { return summary_; }

  /// From its poses, with other weights, by a solver of this kind. Throws std::invalid_argument
  /// (see Reweigh) and EstimatorError where the equations have no finite solution.
  InspectedWindow Solve(const Reweighing& reweighing, SolverKind kind, int max_iterations) const;

 private:
  std::int64_t index_;
  Window window_;
  std::shared_ptr<const RunConfig> config_;
  SolveSummary summary_;
  WindowGraph graph_;
};

}  // namespace trajlo::python
