// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

#include "apps/python/module/arrays.h"
#include "apps/python/module/bindings.h"
#include "apps/python/module/errors.h"
#include "apps/python/module/make_scan.h"
#include "core/io/stamp_text.h"
#include "core/scans/nanoseconds.h"
#include "core/scans/scan_times.h"

namespace trajlo::python {
namespace {

constexpr char kDoc[] = R"(One scan of one LiDAR. It does not change.

points       (N, 3) float32 or float64, metres, in the frame of the LiDAR; NaN for no return;
             or (N, 4): x, y, z, intensity
times_s      (N,) float, seconds after the stamp: when each point was measured
times_ns     (N,) int, nanoseconds, in the clock of stamp_ns; instead of times_s
stamp_ns     int, nanoseconds: when the scan was measured
intensities  (N,) float
lidar        which LiDAR of the rig, from 0; where each one sits is sensor.T_body_lidar

Without times the scan counts as motion-corrected to its stamp, and gets a single pose.
Raises InputError for arrays that do not fit.)";

constexpr auto kStride = static_cast<py::ssize_t>(sizeof(LidarPoint));

template <typename T>
py::array Column(const py::object& self, const T LidarPoint::*member) {
  const auto& points = self.cast<const LidarScan&>().points;
  static const LidarPoint none;
  const LidarPoint& first = points.empty() ? none : points.front();
  return ReadOnlyView(py::dtype::of<T>(), {static_cast<py::ssize_t>(points.size())}, {kStride},
                      &(first.*member), self);
}

py::array Points(const py::object& self) {
  const auto& points = self.cast<const LidarScan&>().points;
  static const LidarPoint none;
  const LidarPoint& first = points.empty() ? none : points.front();
  return ReadOnlyView(py::dtype::of<float>(), {static_cast<py::ssize_t>(points.size()), 3},
                      {kStride, static_cast<py::ssize_t>(sizeof(float))}, first.xyz_m.data(), self);
}

py::array_t<double> TimesAfterStamp(const LidarScan& scan) {
  std::vector<double> times_s;
  times_s.reserve(scan.points.size());
  for (const LidarPoint& point : scan.points) {
    times_s.push_back(Seconds(Difference(point.t_ns, scan.stamp_ns)));
  }
  return CopyOf(times_s);
}

std::string Text(const LidarScan& scan) {
  return "<trajlo.Scan of " + std::to_string(scan.points.size()) + " points at " +
         FormatSeconds(scan.stamp_ns) + " s, LiDAR " + std::to_string(scan.lidar_id) + ">";
}

LidarScan Make(const py::object& points, const py::object& times_s, const py::object& times_ns,
               const py::object& stamp_ns, const py::object& intensities, std::int64_t lidar,
               const py::kwargs& unknown) {
  RefuseUnknown(unknown, "Scan()",
                {"points", "times_s", "times_ns", "stamp_ns", "intensities", "lidar"});
  return MakeScan({points, times_s, times_ns, intensities, stamp_ns, lidar});
}

/// What a pickle holds.
py::tuple State(const py::object& self) {
  const auto& scan = self.cast<const LidarScan&>();
  return py::make_tuple(Points(self).attr("copy")(), Column(self, &LidarPoint::t_ns).attr("copy")(),
                        Column(self, &LidarPoint::intensity).attr("copy")(), scan.stamp_ns,
                        scan.recorded_ns, scan.has_point_times, scan.lidar_id);
}

std::shared_ptr<LidarScan> FromState(const py::tuple& state) {
  if (state.size() != 7) throw DataError("this is no pickle of a scan of this version");
  auto scan = std::make_shared<LidarScan>(MakeScan(
      {state[0], py::none(), state[1], state[2], state[3], state[6].cast<std::int64_t>()}));
  scan->recorded_ns = state[4].cast<std::optional<std::int64_t>>();
  scan->has_point_times = state[5].cast<bool>();
  return scan;
}

}  // namespace

void BindScan(py::module_* module) {
  py::class_<LidarScan, std::shared_ptr<LidarScan>>(*module, "Scan", kDoc)
      .def(py::init(&Make), py::arg("points"), py::arg("times_s") = py::none(), py::kw_only(),
           py::arg("times_ns") = py::none(), py::arg("stamp_ns") = py::none(),
           py::arg("intensities") = py::none(), py::arg("lidar") = 0)
      .def_property_readonly("points", &Points,
                             "(N, 3) float32, metres, LiDAR frame; a read-only view, no copy.")
      .def_property_readonly(
          "times_ns", [](const py::object& self) { return Column(self, &LidarPoint::t_ns); },
          "(N,) int64: when each point was measured; a read-only view, no copy.")
      .def_property_readonly("times_s", &TimesAfterStamp, "(N,) float64: seconds after the stamp.")
      .def_property_readonly(
          "intensities",
          [](const py::object& self) { return Column(self, &LidarPoint::intensity); },
          "(N,) float32; a read-only view, no copy.")
      .def_readonly("stamp_ns", &LidarScan::stamp_ns, "When the scan was measured, ns.")
      .def_readonly("recorded_ns", &LidarScan::recorded_ns,
                    "When it was recorded, by the recorder's clock; None if that is unknown.")
      .def_readonly("has_point_times", &LidarScan::has_point_times,
                    "False for motion-corrected scans.")
      .def_readonly("lidar", &LidarScan::lidar_id, "Which LiDAR of the rig, from 0.")
      .def(py::pickle(&State, &FromState))
      .def("__len__", [](const LidarScan& scan) { return scan.points.size(); })
      .def("__repr__", &Text);
}

}  // namespace trajlo::python
