// SPDX-License-Identifier: MIT
#include "apps/python/module/window_table.h"

#include <pybind11/numpy.h>

#include <cstdint>
#include <string>
#include <type_traits>

#include "core/report/window_columns.h"
#include "core/scans/nanoseconds.h"

namespace trajlo::python {
namespace {

namespace py = pybind11;

/// Calls `put(name, value, dtype)` for each column.
template <typename Put>
class Row {
 public:
  explicit Row(const Put& put) : put_(put) {}

  void Add(const char* name, const std::string& text) { put_(name, py::str(text), "U"); }
  template <typename Number>
  void Add(const char* name, Number number) {
    if constexpr (std::is_integral_v<Number>) {
      put_(name, py::int_(number), "int64");
    } else {
      put_(name, py::float_(number), "float64");
    }
  }
  void AddTime(const char* name, std::int64_t t_ns) {
    Add(name, Seconds(t_ns));
    const std::string stem(name, std::string(name).rfind("_s"));
    Add((stem + "_ns").c_str(), t_ns);
  }

 private:
  const Put& put_;
};

template <typename Put>
void ForEachColumn(const WindowStatistics& window, const Put& put) {
  Row<Put> row(put);
  AddWindowColumns(window, &row);
}

}  // namespace

py::dict WindowTable(const std::vector<WindowStatistics>& windows) {
  py::dict columns, types;
  ForEachColumn({}, [&](const char* name, const py::object&, const char* type) {
    columns[name] = py::list();
    types[name] = type;
  });
  for (const WindowStatistics& window : windows) {
    ForEachColumn(window, [&](const char* name, const py::object& value, const char*) {
      columns[name].cast<py::list>().append(value);
    });
  }
  const py::object make_array = py::module_::import("numpy").attr("array");
  py::dict table;
  for (const auto& [name, values] : columns) {
    table[name] = make_array(values, py::arg("dtype") = types[name]);
  }
  return table;
}

py::dict WindowRow(const WindowStatistics& window) {
  py::dict row;
  ForEachColumn(window,
                [&](const char* name, const py::object& value, const char*) { row[name] = value; });
  return row;
}

}  // namespace trajlo::python
