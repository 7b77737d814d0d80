// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <memory>

#include "apps/python/module/bindings.h"
#include "apps/python/module/make_scan.h"
#include "apps/python/module/odometry_session.h"

namespace trajlo::python {
namespace {

std::unique_ptr<OdometrySession> Make(const RunConfig& config, const py::object& on_window,
                                      const py::object& on_solved, const py::object& on_pose,
                                      bool covariance) {
  for (const py::object& callback : {on_window, on_solved, on_pose}) {
    if (!callback.is_none() && PyCallable_Check(callback.ptr()) == 0) {
      throw py::type_error("on_window, on_solved and on_pose must be callable, or None");
    }
  }
  CheckConfig(config);
  return std::make_unique<OdometrySession>(
      config, SessionRequest{on_window, on_solved, on_pose, covariance});
}

}  // namespace

void BindOdometry(py::module_* module) {
  py::class_<OdometrySession>(*module, "Session", "An estimator and what it has estimated.")
      .def(py::init(&Make), py::arg("config"), py::arg("on_window"), py::arg("on_solved"),
           py::arg("on_pose"), py::arg("covariance"))
      .def("add", &OdometrySession::Add, py::arg("scan"))
      .def("finish", &OdometrySession::Finish)
      .def_property_readonly("is_finished", &OdometrySession::is_finished)
      .def("trajectory", &OdometrySession::Poses)
      .def("windows", &OdometrySession::Windows)
      .def("covariances", &OdometrySession::Covariances)
      .def("map", &OdometrySession::MapPoints)
      .def("point_counts", &OdometrySession::PointCounts)
      .def("rig", &OdometrySession::Rig)
      .def("lost_at_ns",
           [](const OdometrySession& session) { return session.odometry().lost_at_ns(); })
      .def("remarks", &OdometrySession::Remarks)
      .def("take_doubt_of_times", &OdometrySession::TakeDoubtOfTimes, py::arg("at_end"))
      .def("expects_times", &OdometrySession::ExpectsTimes, py::arg("lidar"))
      .def("shortcomings", &OdometrySession::Shortcomings);
}

}  // namespace trajlo::python
