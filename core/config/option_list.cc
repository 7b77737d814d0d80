// SPDX-License-Identifier: MIT
// The one list of all options: a line each, in the order of the dump.
#include <algorithm>
#include <initializer_list>
#include <utility>

#include "core/config/option.h"

namespace trajlo {
namespace {

template <typename T>
struct Range {
  T min, max;
};

template <typename Value>
using Names = std::vector<std::pair<const char*, Value>>;

class Binder {
 public:
  void Add(const char* key, bool& value, const char* doc) { Push(key, doc, FlagField{&value}); }

  void Add(const char* key, int& value, Range<int> range, const char* doc) {
    Push(key, doc, IntegerField{&value, range.min, range.max});
  }

  void Add(const char* key, double& value, Range<double> range, const char* doc) {
    Push(key, doc, RealField{&value, range.min, range.max});
  }

  void Add(const char* key, std::string& value, const char* doc) {
    Push(key, doc, TextField{[&value] { return value; }, [&value](const auto& s) { value = s; }});
  }

  void Add(const char* key, std::filesystem::path& value, const char* doc) {
    Push(key, doc,
         TextField{[&value] { return value.string(); }, [&value](const auto& s) { value = s; }});
  }

  void Add(const char* key, std::vector<SE3>& value, const char* doc) {
    Push(key, doc, ExtrinsicsField{&value});
  }

  template <typename Value>
  void Add(const char* key, Value& value, const Names<Value>& names, const char* doc) {
    Push(key, doc,
         Choice(
             names, [&value]() -> Value { return value; },
             [&value](Value chosen) { value = chosen; }));
  }

  void Add(const char* key, std::vector<std::string>& values, const char* doc) {
    Push(key, doc, List(values, true, [&values](std::size_t i) { return TextAt(values, i); }));
  }

  void Add(const char* key, PerLidar<std::string>& value, const char* doc) {
    auto& values = value.values;
    Push(key, doc, List(values, false, [&values](std::size_t i) { return TextAt(values, i); }));
  }

  void Add(const char* key, PerLidar<double>& value, Range<double> range, const char* doc) {
    auto& values = value.values;
    Push(key, doc, List(values, false, [&values, range](std::size_t i) {
           return RealField{&values[i], range.min, range.max};
         }));
  }

  template <typename Value>
  void Add(const char* key, PerLidar<Value>& value, const Names<Value>& names, const char* doc) {
    auto& values = value.values;
    Push(key, doc, List(values, false, [&values, names](std::size_t i) {
           return Choice(
               names, [&values, i]() -> Value { return values[i]; },
               [&values, i](Value chosen) { values[i] = chosen; });
         }));
  }

  std::vector<Option> options;

 private:
  template <typename Value, typename At>
  static ListField List(std::vector<Value>& values, bool may_be_empty, At at) {
    return {may_be_empty, [&values] { return values.size(); },
            [&values](std::size_t size) { values.resize(size); }, at};
  }

  static TextField TextAt(std::vector<std::string>& values, std::size_t i) {
    return {[&values, i] { return values[i]; },
            [&values, i](const std::string& text) { values[i] = text; }};
  }

  template <typename Value, typename Get, typename Set>
  static ChoiceField Choice(const Names<Value>& names, Get get, Set set) {
    ChoiceField field;
    for (const auto& [name, meaning] : names) field.names.emplace_back(name);
    field.get = [names, get] {
      const auto found = std::find_if(names.begin(), names.end(),
                                      [&](const auto& name) { return name.second == get(); });
      return static_cast<std::size_t>(found - names.begin());
    };
    field.set = [names, set](std::size_t index) { set(names[index].second); };
    return field;
  }

  template <typename Field>
  void Push(const char* key, const char* doc, Field field) {
    options.push_back({key, doc, std::move(field)});
  }
};

const Names<bool> kPointTimes = {{"auto", true}, {"none", false}};
const Names<TimeUnit> kTimeUnits = {{"auto", TimeUnit::kAuto},
                                    {"s", TimeUnit::kSeconds},
                                    {"ms", TimeUnit::kMilliseconds},
                                    {"us", TimeUnit::kMicroseconds},
                                    {"ns", TimeUnit::kNanoseconds}};
const Names<TimeOrigin> kTimeOrigins = {{"auto", TimeOrigin::kAuto},
                                        {"start", TimeOrigin::kSweepStart},
                                        {"stamp", TimeOrigin::kStamp},
                                        {"end", TimeOrigin::kSweepEnd},
                                        {"absolute", TimeOrigin::kAbsolute}};
const Names<StampAt> kStampEnds = {
    {"auto", StampAt::kAuto}, {"start", StampAt::kStart}, {"end", StampAt::kEnd}};
const Names<MapKind> kMapKinds = {{"voxel_hash", MapKind::kVoxelHash},
                                  {"kd_tree", MapKind::kKdTree}};
const Names<KernelKind> kKernels = {{"none", KernelKind::kNone},
                                    {"huber", KernelKind::kHuber},
                                    {"cauchy", KernelKind::kCauchy},
                                    {"geman_mcclure", KernelKind::kGemanMcClure},
                                    {"tukey", KernelKind::kTukey}};
const Names<SolverKind> kSolvers = {{"ceres", SolverKind::kCeres},
                                    {"gauss_newton", SolverKind::kGaussNewton}};
const Names<LinearSolverKind> kLinearSolvers = {
    {"dense_normal_cholesky", LinearSolverKind::kDenseNormalCholesky},
    {"dense_qr", LinearSolverKind::kDenseQr},
    {"sparse_normal_cholesky", LinearSolverKind::kSparseNormalCholesky},
    {"cgnr", LinearSolverKind::kCgnr}};
const Names<RegistrationForm> kRegistrationForms = {
    {"prepared", RegistrationForm::kPrepared},
    {"condensed", RegistrationForm::kCondensed},
    {"segment_residuals", RegistrationForm::kSegmentResiduals},
    {"point", RegistrationForm::kPoint},
    {"point_autodiff", RegistrationForm::kPointAutodiff}};
const Names<TrustRegionKind> kTrustRegions = {
    {"levenberg_marquardt", TrustRegionKind::kLevenbergMarquardt},
    {"dogleg", TrustRegionKind::kDogleg}};

void BindInput(RecordingOptions* input, Binder* b) {
  b->Add("input.topics", input->topics,
         "Topics of a bag to read, one per LiDAR; empty takes the only one with point clouds.");
  b->Add("input.point_time", input->use_point_times, kPointTimes,
         "none: ignore per-point times, as motion-corrected scans need it; every point then gets "
         "its scan's stamp.");
  b->Add("input.time_field", input->time_field,
         "Name of the field with the points' times; empty takes the first with a known name.");
  b->Add("input.time_unit", input->time_unit, kTimeUnits,
         "Unit of the points' times; auto decides by the evidence of the first scans.");
  b->Add("input.time_origin", input->time_origin, kTimeOrigins,
         "What a point time of zero means: start or end of the sweep, the scan's stamp, or the "
         "zero of an absolute clock.");
  b->Add("input.stamp_at", input->stamp_at, kStampEnds,
         "Which end of the sweep a scan's stamp marks.");
  b->Add("input.clock_offset_s", input->clock_offset_s, Range<double>{-1e9, 1e9},
         "Added to the stamps and times of a LiDAR whose clock is late by this much.");
  b->Add("input.stamps_file", input->stamps_file,
         "File with one stamp a line; empty searches for timestamps.txt or times.txt.");
  b->Add("input.scan_period_s", input->scan_period_s, Range<double>{1e-3, 100.0},
         "Time between scans when nothing else gives stamps.");
  b->Add("input.start_s", input->start_s, Range<double>{0.0, 1e9},
         "Scans before this much time since the first are skipped.");
  b->Add("input.duration_s", input->duration_s, Range<double>{0.0, 1e9},
         "The length of what is read; 0 reads to the end.");
}

void BindSensing(SegmenterOptions* segmenter, Binder* b) {
  b->Add("sensor.T_body_lidar", segmenter->T_body_lidar,
         "Pose of each LiDAR in the body frame; LiDARs beyond the list have the identity.");
  b->Add("sensor.min_range_m", segmenter->min_range_m, Range<double>{0.0, 1e3},
         "Nearer points are dropped.");
  b->Add("sensor.max_range_m", segmenter->max_range_m, Range<double>{0.1, 1e4},
         "Farther points are dropped.");
  b->Add("sensor.vertical_correction_deg", segmenter->vertical_correction_deg,
         Range<double>{-5.0, 5.0},
         "Turns every ray up by this angle: the calibration error of KITTI's HDL-64E is 0.205.");
  b->Add("segmenter.first_interval_s", segmenter->first_interval_s, Range<double>{1e-3, 10.0},
         "Length of the first segment, which fills the map (paper: 0.3 s).");
  b->Add("segmenter.interval_s", segmenter->interval_s, Range<double>{1e-3, 10.0},
         "Length of all other segments, the paper's Delta t.");
  b->Add("segmenter.map_voxel_m", segmenter->map_voxel_m, Range<double>{1e-3, 10.0},
         "At most one point per cell of this size and segment enters the map.");
  b->Add("segmenter.registration_voxel_m", segmenter->registration_voxel_m,
         Range<double>{1e-3, 20.0}, "At most one of those per cell of this size is registered.");
  b->Add("segmenter.max_registration_points", segmenter->max_registration_points,
         Range<int>{0, 1000000},
         "At most this many are registered of a segment, taken evenly over its points; 0 takes "
         "all.");
  b->Add("segmenter.max_gap_s", segmenter->max_gap_s, Range<double>{1e-3, 1e3},
         "A longer pause becomes one gap segment; shorter ones become empty segments.");
  b->Add("segmenter.max_lag_s", segmenter->max_lag_s, Range<double>{0.0, 1e3},
         "A LiDAR that lags behind the others by more is not waited for.");
}

void BindMap(MapPyramidOptions* pyramid, Binder* b) {
  MapOptions* map = &pyramid->finest;
  b->Add("map.kind", map->kind, kMapKinds,
         "voxel_hash is fast; kd_tree finds the exact neighbours.");
  b->Add("map.voxel_size_m", map->voxel_size_m, Range<double>{1e-2, 20.0},
         "Edge of a voxel (paper: 0.4 m indoors, 0.8 m outdoors).");
  b->Add("map.max_points_per_voxel", map->max_points_per_voxel, Range<int>{1, 1000},
         "A full voxel takes no more points.");
  b->Add("map.min_point_spacing_m", map->min_point_spacing_m, Range<double>{0.0, 10.0},
         "A point nearer than this to another of its voxel is not added: otherwise a sensor at "
         "rest fills the voxels with copies of the same rings.");
  b->Add("map.radius_m", map->radius_m, Range<double>{1.0, 1e4},
         "Voxels farther than this from the sensor are dropped.");
  b->Add("map.levels", pyramid->levels, Range<int>{1, 8},
         "Maps of growing coarseness, asked in turn until one has a plane; 1 is the paper's map.");
  b->Add("map.level_ratio", pyramid->level_ratio, Range<double>{1.1, 10.0},
         "Voxels and spacing grow by this from level to level.");
}

void BindAssociation(AssociationOptions* association, Binder* b) {
  PlaneFitOptions& plane = association->plane;
  b->Add("association.plane.neighbors", plane.neighbors, Range<int>{3, kMaxNeighbors},
         "Map points taken for a plane (paper: 5).");
  b->Add("association.plane.min_neighbors", plane.min_neighbors, Range<int>{3, kMaxNeighbors},
         "Fewer make no plane.");
  b->Add("association.plane.max_thickness_m", plane.max_thickness_m, Range<double>{1e-4, 10.0},
         "Upper bound of the neighbours' standard deviation across the plane.");
  b->Add("association.plane.min_width_in_spacings", plane.min_width_in_spacings,
         Range<double>{0.0, 10.0},
         "Lower bound of their standard deviation along the plane's shorter axis, in spacings of "
         "the map's points: neighbours on one scan line have no normal.");
  b->Add("association.plane.max_flatness", plane.max_flatness, Range<double>{1e-3, 1.0},
         "Upper bound of the ratio of the first to the second.");
  b->Add("association.plane.half_weight_thickness_m", plane.half_weight_thickness_m,
         Range<double>{1e-4, 100.0},
         "A plane of this thickness weighs half as much as a thin one.");
  b->Add("association.reach_in_thresholds", association->reach_in_thresholds,
         Range<double>{0.1, 100.0},
         "The nearest neighbour may be this many adaptive thresholds away.");
  b->Add("association.reassociate_distance_m", association->reassociate_distance_m,
         Range<double>{0.0, 10.0},
         "A point keeps its plane until it has moved by more than this since the look-up.");
}

void BindThreshold(AdaptiveThresholdOptions* threshold, Binder* b) {
  b->Add("threshold.adaptive", threshold->adaptive,
         "Learn the threshold from how far predictions were off; false keeps initial_m.");
  b->Add("threshold.initial_m", threshold->initial_m, Range<double>{1e-3, 100.0},
         "Used until there is evidence.");
  b->Add("threshold.min_m", threshold->min_m, Range<double>{1e-3, 100.0},
         "Never smaller than this.");
  b->Add("threshold.max_m", threshold->max_m, Range<double>{1e-3, 100.0},
         "Never larger than this.");
  b->Add("threshold.min_motion_m", threshold->min_motion_m, Range<double>{0.0, 10.0},
         "Prediction errors below this say nothing about what is needed.");
  b->Add("threshold.range_m", threshold->range_m, Range<double>{0.1, 1e3},
         "Lever arm with which a rotation error counts.");
  b->Add("threshold.forgetting", threshold->forgetting, Range<double>{1e-6, 1.0},
         "Share of the newest error in the running mean of squares.");
}

void BindWeights(WeightOptions* weights, Binder* b) {
  b->Add("weights.registration_sigma_m", weights->registration_sigma_m, Range<double>{1e-4, 10.0},
         "Sigma of a point's distance to its plane (paper: covariance 0.1).");
  b->Add("weights.kernel", weights->kernel, kKernels, "Robust kernel on that distance.");
  b->Add("weights.kernel_in_thresholds", weights->kernel_in_thresholds, Range<double>{1e-3, 100.0},
         "Width of the kernel: this share of the adaptive threshold, within the bounds below.");
  b->Add("weights.min_kernel_m", weights->min_kernel_m, Range<double>{1e-3, 100.0},
         "The kernel is never narrower.");
  b->Add("weights.max_kernel_m", weights->max_kernel_m, Range<double>{1e-3, 100.0},
         "The kernel is never wider.");
  b->Add("weights.smoothness_sigma_translation_m", weights->smoothness_sigma_translation_m,
         Range<double>{1e-6, 1e3},
         "Sigma of a segment's change of translation against the one before (paper: covariance "
         "0.05).");
  b->Add("weights.smoothness_sigma_rotation_rad", weights->smoothness_sigma_rotation_rad,
         Range<double>{1e-6, 1e3}, "The same for the rotation.");
  b->Add("weights.smoothness_interval_s", weights->smoothness_interval_s, Range<double>{1e-4, 10.0},
         "The sigmas are meant for segments up to this long; for longer ones they grow with the "
         "square of the interval, as the way does that an acceleration changes.");
  b->Add("weights.smoothness_scales_with_points", weights->smoothness_scales_with_points,
         "Divides both by the root of the summed weights of the segment's associated points, so "
         "that the balance between "
         "geometry and motion does not depend on the density of the sensor.");
}

void BindWeightBalance(WeightBalanceOptions* balance, Binder* b) {
  b->Add("weight_balance.enabled", balance->enabled,
         "Lets the smoothness sigmas find themselves from the residuals of the last seconds "
         "(variance components); the configured ones are where they start.");
  b->Add("weight_balance.memory_s", balance->memory_s, Range<double>{0.01, 1e6},
         "Time over which residuals are remembered.");
  b->Add("weight_balance.prior_s", balance->prior_s, Range<double>{0.0, 1e6},
         "The configured sigmas count like residuals of this much time that agree with them.");
  b->Add("weight_balance.points_per_error", balance->points_per_error, Range<double>{1.0, 1e6},
         "Points that hit the same surfaces of the map share its errors: so many count as one.");
  b->Add("weight_balance.max_factor", balance->max_factor, Range<double>{1.0, 1e4},
         "The sigmas stay within this factor of the configured ones.");
}

void BindSolver(SolverOptions* solver, Binder* b) {
  b->Add("solver.kind", solver->kind, kSolvers,
         "Ceres, or the hand-written Gauss-Newton of the paper.");
  b->Add("solver.max_rounds", solver->max_rounds, Range<int>{1, 1000},
         "At most this many rounds of association and solve a window.");
  b->Add("solver.iterations_per_round", solver->iterations_per_round, Range<int>{1, 1000},
         "At most this many solver iterations in each round.");
  b->Add("solver.step_tolerance_m", solver->step_tolerance_m, Range<double>{0.0, 1.0},
         "The rounds end when no control pose moved by more than this ...");
  b->Add("solver.step_tolerance_rad", solver->step_tolerance_rad, Range<double>{0.0, 1.0},
         "... and turned by no more than this.");
  CeresOptions& ceres = solver->ceres;
  b->Add("solver.ceres.registration", ceres.registration, kRegistrationForms,
         "How the registration enters Ceres: 13 condensed rows a segment, computed in parallel or "
         "each by itself; one block a segment with a residual a point; one block a point with "
         "analytic or automatic Jacobians (without first-estimate Jacobians).");
  b->Add("solver.ceres.linear_solver", ceres.linear_solver, kLinearSolvers,
         "How Ceres solves the normal equations.");
  b->Add("solver.ceres.trust_region", ceres.trust_region, kTrustRegions,
         "How Ceres bounds its steps.");
  b->Add("solver.ceres.initial_trust_region_radius", ceres.initial_trust_region_radius,
         Range<double>{1e-10, 1e16},
         "The largest makes the first step a Gauss-Newton step to the last bits.");
  b->Add("solver.ceres.function_tolerance", ceres.function_tolerance, Range<double>{0.0, 1.0},
         "Ceres drops a step that lowers the cost by a smaller share, and stops.");
  b->Add("solver.ceres.gradient_tolerance", ceres.gradient_tolerance, Range<double>{0.0, 1.0},
         "Ceres stops when the largest entry of the gradient is smaller.");
  b->Add("solver.ceres.parameter_tolerance", ceres.parameter_tolerance, Range<double>{0.0, 1.0},
         "Ceres drops a step that is smaller than this share of the state, and stops.");
}

void BindMarginalization(MarginalizationOptions* marginalization, Binder* b) {
  b->Add("marginalization.enabled", marginalization->enabled,
         "false: what leaves the window is forgotten, and its last pose is held by the anchor's "
         "sigmas.");
  b->Add("marginalization.first_estimate_jacobians", marginalization->first_estimate_jacobians,
         "Keeps the Jacobians of a pose in the prior at the linearisation point of the prior.");
  b->Add("marginalization.use_qr", marginalization->use_qr,
         "Orthogonal elimination in place of the Schur complement.");
  b->Add("marginalization.anchor_sigma_translation_m", marginalization->anchor_sigma_translation_m,
         Range<double>{1e-9, 1e3}, "Sigma with which the first control pose is held.");
  b->Add("marginalization.anchor_sigma_rotation_rad", marginalization->anchor_sigma_rotation_rad,
         Range<double>{1e-9, 1e3}, "The same for its rotation.");
}

void BindEstimation(OdometryOptions* odometry, Binder* b) {
  b->Add("window.segments", odometry->window.segments, Range<int>{1, 100},
         "Segments that are estimated together, the paper's K.");
  InitializationOptions& initialization = odometry->initialization;
  b->Add("initialization.estimate_motion", initialization.estimate_motion,
         "Estimates the motion during the first interval by registering its second half to its "
         "first one; false assumes a stationary start, as the paper does.");
  b->Add("initialization.min_gain", initialization.min_gain, Range<double>{1.0, 100.0},
         "The estimated motion is believed only if it brings this many times as many points onto "
         "planes as standing still does ...");
  b->Add("initialization.clear_motion_m", initialization.clear_motion_m, Range<double>{0.0, 1e3},
         "... or simply more, where it is longer than this: at rest the estimate is off by "
         "centimetres.");
  b->Add("lost.min_inlier_share", odometry->lost.min_inlier_share, Range<double>{0.0, 1.0},
         "The estimator is lost when fewer than this share of the points find a plane ...");
  b->Add("lost.max_duration_s", odometry->lost.max_duration_s, Range<double>{0.0, 1e6},
         "... for longer than this ...");
  b->Add("lost.max_unconverged_s", odometry->lost.max_unconverged_s, Range<double>{0.0, 1e6},
         "... or when no window converges for longer than this.");
  b->Add("lost.max_correction_m", odometry->lost.max_correction_m, Range<double>{1e-3, 1e3},
         "A solve that moves the newest pose farther than this from its prediction ...");
  b->Add("lost.max_correction_rad", odometry->lost.max_correction_rad, Range<double>{1e-3, 10.0},
         "... or turns it by more than this is not believed.");
  b->Add("lost.degenerate_eigenvalue", odometry->lost.degenerate_eigenvalue,
         Range<double>{0.0, 1.0},
         "Below this information per point a direction counts as degenerate (a well-spread scene "
         "has 0.05 to 0.2).");
  b->Add("covariance_scale", odometry->covariance_scale, Range<double>{1e-6, 1e9},
         "Multiplies the covariances that are written: the window takes the map for exact and the "
         "errors of its points for independent, so 1 is optimistic.");
  b->Add("threads", odometry->threads, Range<int>{0, 1024},
         "0 takes all cores; no result depends on it.");
}

}  // namespace

std::vector<Option> BindOptions(RunConfig* config) {
  OdometryOptions* odometry = &config->odometry;
  Binder binder;
  BindInput(&config->input, &binder);
  BindSensing(&odometry->segmenter, &binder);
  BindMap(&odometry->map, &binder);
  BindAssociation(&odometry->association, &binder);
  BindThreshold(&odometry->threshold, &binder);
  BindWeights(&odometry->weights, &binder);
  BindWeightBalance(&odometry->weight_balance, &binder);
  BindSolver(&odometry->solver, &binder);
  BindMarginalization(&odometry->marginalization, &binder);
  BindEstimation(odometry, &binder);
  return std::move(binder.options);
}

std::string SectionDoc(const std::string& section) {
  static const std::vector<std::pair<std::string, std::string>> docs = {
      {"input",
       "How the recording is read. Times that are left to auto are decided by evidence, "
       "which is printed."},
      {"sensor", "The LiDARs."},
      {"segmenter", "How the stream of points is cut into segments and thinned."},
      {"map", "The local map that points are registered to."},
      {"association", "How a point finds its plane."},
      {"association.plane", "When neighbours make a plane."},
      {"threshold",
       "How far off predictions are taken to be: it sets how far associations reach "
       "and how wide the robust kernel is."},
      {"weights", "The weights of the energy."},
      {"weight_balance", "How the ratio between geometry and smoothness finds itself."},
      {"solver", "How a window is solved."},
      {"solver.ceres", "Only read by the Ceres solver."},
      {"marginalization", "How the past is kept when a segment leaves the window."},
      {"window", "The sliding window."},
      {"initialization", "How the first interval is treated."},
      {"lost", "When the estimator stops believing itself."},
  };
  for (const auto& [name, doc] : docs) {
    if (name == section) return doc;
  }
  return "";
}

}  // namespace trajlo
