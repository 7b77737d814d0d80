// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/evaluation/evaluation.h"

namespace trajlo {

// What stands in the flags of trajlo_evaluate. All throw UsageError, with the name of the flag.

/// "interpolate", "interpolate_estimate", "nearest", "one_to_one".
AssociationRule ParseAssociation(const std::string& text);
const char* AssociationName(AssociationRule rule);

/// "se3", "sim3", "scale", "origin", "none".
AlignmentKind ParseAlignment(const std::string& text);
const char* AlignmentName(AlignmentKind kind);

/// "auto" (all with the association that copies evo, the last with the one that copies the TUM
/// RGB-D benchmark, else the first), "first", "last", "all".
RepeatedStamps ParseRepeatedStamps(const std::string& text, AssociationRule rule);
const char* RepeatedStampsName(RepeatedStamps repeated_stamps);

/// "auto", "use", "ignore".
TruthOrientation ParseTruthOrientation(const std::string& text);

/// "100" pairs or "10s" seconds at the beginning; empty for all.
void ParseAlignFirst(const std::string& text, AlignmentOptions* options);

/// Pieces of relative errors, as in "1m,10m,1s,10f,5d".
std::vector<RelativeErrorOptions> ParsePieces(const std::string& text);

/// "x,y,z" in metres.
Eigen::Affine3d ParseLeverArm(const std::string& text);

/// "x,y,z,qx,qy,qz,qw" or the first three rows of the matrix (12 or, with the last row, 16
/// numbers).
Eigen::Affine3d ParsePose(const std::string& text);

}  // namespace trajlo
