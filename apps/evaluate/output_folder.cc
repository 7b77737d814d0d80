// SPDX-License-Identifier: MIT
#include "apps/evaluate/output_folder.h"

#include "apps/evaluate/evaluation_csv.h"
#include "apps/evaluate/evaluation_json.h"
#include "apps/evaluate/evaluation_tex.h"
#include "core/io/atomic_file.h"
#include "core/report/drawn_files.h"
#include "core/report/result_folder.h"

namespace trajlo {

namespace fs = std::filesystem;

void CheckEvaluationFolder(const fs::path& folder, bool overwrite) {
  CheckResultFolder(folder, EvaluationFiles(folder), overwrite);
}

void WriteEvaluation(const EvaluateRequest& request, const EvaluationReport& report) {
  const fs::path& folder = request.output;
  const IfExists if_exists = request.overwrite ? IfExists::kReplace : IfExists::kFail;
  PrepareResultFolder(folder, EvaluationFiles(folder));
  for (const EstimateReport& estimate : report.estimates) {
    if (!estimate.evaluation) continue;
    WriteTextFile(folder / estimate.errors_csv,
                  ErrorsCsv(*estimate.evaluation, report.truth.has_stamps), if_exists);
  }
  WriteTextFile(folder / "evaluation.csv", EvaluationCsv(request, report), if_exists);
  WriteTextFile(folder / "evaluation.tex", EvaluationTex(request, report), if_exists);
  WriteTextFile(folder / "evaluation.json", EvaluationJson(request, report), if_exists);
}

}  // namespace trajlo
