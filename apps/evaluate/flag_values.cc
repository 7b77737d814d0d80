// SPDX-License-Identifier: MIT
#include "apps/evaluate/flag_values.h"

#include <cmath>
#include <sstream>
#include <utility>

#include "apps/split_at_commas.h"
#include "apps/usage_error.h"
#include "core/io/number_text.h"
#include "core/options/did_you_mean.h"

namespace trajlo {
namespace {

template <typename T>
using Names = std::vector<std::pair<const char*, T>>;

const Names<AssociationRule> kAssociations = {
    {"interpolate", AssociationRule::kInterpolate},
    {"interpolate_estimate", AssociationRule::kInterpolateEstimate},
    {"nearest", AssociationRule::kNearest},
    {"one_to_one", AssociationRule::kOneToOne}};
const Names<AlignmentKind> kAlignments = {{"se3", AlignmentKind::kSe3},
                                          {"sim3", AlignmentKind::kSim3},
                                          {"scale", AlignmentKind::kScale},
                                          {"origin", AlignmentKind::kOrigin},
                                          {"none", AlignmentKind::kNone}};
const Names<RepeatedStamps> kRepeatedStamps = {{"first", RepeatedStamps::kFirst},
                                               {"last", RepeatedStamps::kLast},
                                               {"all", RepeatedStamps::kAll}};
const Names<TruthOrientation> kOrientations = {{"auto", TruthOrientation::kAuto},
                                               {"use", TruthOrientation::kUse},
                                               {"ignore", TruthOrientation::kIgnore}};

template <typename T>
T Find(const Names<T>& names, const char* flag, const std::string& text) {
  std::vector<std::string> known;
  std::string list;
  for (const auto& [name, value] : names) {
    if (text == name) return value;
    known.emplace_back(name);
    list += std::string(list.empty() ? "" : ", ") + name;
  }
  throw UsageError(std::string("--") + flag + ": must be one of " + list + ", found '" + text +
                   "'" + DidYouMean(text, known));
}

template <typename T>
const char* NameOf(const Names<T>& names, T value) {
  for (const auto& [name, named] : names) {
    if (named == value) return name;
  }
  return "";
}

std::vector<double> Numbers(const char* flag, const std::string& text) {
  std::string blanks = text;
  for (char& c : blanks) {
    if (c == ',' || c == ';') c = ' ';
  }
  std::istringstream words(blanks);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    double number = 0.0;
    if (!ParseNumber(word, &number) || !std::isfinite(number)) {
      throw UsageError(std::string("--") + flag + ": '" + word + "' is not a number");
    }
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

AssociationRule ParseAssociation(const std::string& text) {
  return Find(kAssociations, "association", text);
}
const char* AssociationName(AssociationRule rule) { return NameOf(kAssociations, rule); }

AlignmentKind ParseAlignment(const std::string& text) {
  return Find(kAlignments, "alignment", text);
}
const char* AlignmentName(AlignmentKind kind) { return NameOf(kAlignments, kind); }

RepeatedStamps ParseRepeatedStamps(const std::string& text, AssociationRule rule) {
  if (text == "auto") {
    if (rule == AssociationRule::kNearest) return RepeatedStamps::kAll;
    if (rule == AssociationRule::kOneToOne) return RepeatedStamps::kLast;
    return RepeatedStamps::kFirst;
  }
  return Find(kRepeatedStamps, "repeated_stamps", text);
}
const char* RepeatedStampsName(RepeatedStamps repeated_stamps) {
  return NameOf(kRepeatedStamps, repeated_stamps);
}

TruthOrientation ParseTruthOrientation(const std::string& text) {
  return Find(kOrientations, "truth_orientation", text);
}

void ParseAlignFirst(const std::string& text, AlignmentOptions* options) {
  if (text.empty()) return;
  const bool seconds = text.back() == 's';
  double number = 0.0;
  if (!ParseNumber(text.substr(0, text.size() - (seconds ? 1 : 0)), &number) ||
      !(number > 0.0 && number < 1e9) || (!seconds && number != std::floor(number))) {
    throw UsageError("--align_first: must be a number of pairs (100) or of seconds (10s), found '" +
                     text + "'");
  }
  if (seconds) {
    options->first_seconds = number;
  } else {
    options->first_pairs = static_cast<std::size_t>(number);
  }
}

std::vector<RelativeErrorOptions> ParsePieces(const std::string& text) {
  std::vector<RelativeErrorOptions> pieces;
  for (const std::string& part : SplitAtCommas(text)) {
    RelativeErrorOptions piece;
    bool known_unit = false;
    for (const DeltaUnit unit :
         {DeltaUnit::kMetres, DeltaUnit::kSeconds, DeltaUnit::kFrames, DeltaUnit::kDegrees}) {
      if (part.back() != DeltaUnitName(unit)[0]) continue;
      piece.unit = unit;
      known_unit = true;
    }
    if (!known_unit || !ParseNumber(part.substr(0, part.size() - 1), &piece.delta) ||
        !(piece.delta > 0.0 && piece.delta < 1e9) ||
        (piece.unit == DeltaUnit::kFrames && piece.delta != std::floor(piece.delta))) {
      throw UsageError(
          "--rpe: must be lengths with a unit, m, s, f (frames) or d (degrees), as in "
          "1m,10m,1s,10f; found '" +
          part + "'");
    }
    pieces.push_back(piece);
  }
  return pieces;
}

Eigen::Affine3d ParseLeverArm(const std::string& text) {
  const std::vector<double> v = Numbers("lever_arm", text);
  if (v.size() != 3) throw UsageError("--lever_arm: must be x,y,z in metres");
  return Eigen::Affine3d(Eigen::Translation3d(v[0], v[1], v[2]));
}

Eigen::Affine3d ParsePose(const std::string& text) {
  const std::vector<double> v = Numbers("T_body_truth", text);
  const auto fail = [](const std::string& problem) {
    throw UsageError("--T_body_truth: " + problem);
  };
  if (v.size() == 7) {
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (std::abs(q.norm() - 1.0) > 1e-2) fail("the quaternion is not normalised");
    return Eigen::Translation3d(v[0], v[1], v[2]) * q.normalized();
  }
  if (v.size() != 12 && v.size() != 16) {
    fail("must be x,y,z,qx,qy,qz,qw or the 12 numbers of the matrix's first three rows");
  }
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  for (int i = 0; i < 12; ++i) T.matrix()(i / 4, i % 4) = v[static_cast<std::size_t>(i)];
  const Eigen::Matrix3d R = T.linear();
  if (!(R.transpose() * R).isIdentity(1e-3) || R.determinant() < 0.0) {
    fail("the first three columns are not a rotation");
  }
  return T;
}

}  // namespace trajlo
