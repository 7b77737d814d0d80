// SPDX-License-Identifier: MIT
#pragma once

namespace trajlo {

/// What the commands tell the shell.
enum class ExitCode {
  kOk = 0,
  kUsage = 1,            ///< Wrong flags or configuration.
  kInputUnreadable = 2,  ///< Nothing could be read.
  kPartialInput = 3,     ///< The result rests on a part of the input, or on no sure pose.
  kLost = 4,             ///< The estimator got lost; the result until then is written and flagged.
  kOutputNotWritable = 5,  ///< Disk full, no permission, or an earlier result would be replaced.
  kFailed = 6,             ///< Out of memory or threads, or a defect of the program.
  kInterrupted = 130,      ///< By a signal; the result until then is written.
};

}  // namespace trajlo
