// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <vector>

#include "apps/python/module/bindings.h"
#include "apps/python/module/exclusive.h"
#include "core/config/config.h"
#include "core/io/recording/open_recording.h"

namespace trajlo::python {
namespace {

namespace py = pybind11;

/// One pass through a recording, without the GIL while it reads.
class Reader {
 public:
  Reader(const std::vector<std::string>& inputs, const RunConfig& config) {
    const py::gil_scoped_release release;
    source_ = OpenRecording(inputs, config.input, config.odometry.threads);
  }

  std::shared_ptr<LidarScan> Next() {
    auto scan = std::make_shared<LidarScan>();
    if (!Read(scan.get())) throw py::stop_iteration();
    return scan;
  }

  std::size_t size() const {
    exclusive_.AwaitReadable();
    return source_->size();
  }
  const std::string& description() const {
    exclusive_.AwaitReadable();
    return source_->description();
  }

  py::dict Report() const {
    exclusive_.AwaitReadable();
    const ReadReport& report = source_->report();
    py::dict dict;
    dict["scans_listed"] = report.scans_listed;
    dict["scans_read"] = report.scans_read;
    dict["scans_damaged"] = report.scans_damaged;
    dict["scans_skipped"] = report.scans_skipped;
    dict["scans_left_out"] = report.scans_left_out;
    dict["file_is_cut"] = report.file_is_cut;
    dict["topics_without_messages"] = report.topics_without_messages;
    dict["points_read"] = report.points_read;
    dict["points_without_time"] = report.points_without_time;
    dict["points_undeclared"] = report.points_undeclared;
    dict["warnings"] = report.warnings;
    dict["is_partial"] = report.IsPartial();
    return dict;
  }

 private:
  bool Read(LidarScan* scan) {
    const Exclusive::Claim claim(&exclusive_);
    const py::gil_scoped_release release;
    return source_->Next(scan);
  }

  std::unique_ptr<ScanSource> source_;
  Exclusive exclusive_;
};

}  // namespace

void BindReader(py::module_* module) {
  py::class_<Reader>(*module, "Reader", "One pass through a recording.")
      .def(py::init<const std::vector<std::string>&, const RunConfig&>(), py::arg("inputs"),
           py::arg("config"))
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &Reader::Next)
      .def_property_readonly("size", &Reader::size, "Scans that the recording lists.")
      .def_property_readonly("description", &Reader::description,
                             "What is read and how it is understood.")
      .def("report", &Reader::Report, "What happened so far.");
}

}  // namespace trajlo::python
