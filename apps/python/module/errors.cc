// SPDX-License-Identifier: MIT
#include "apps/python/module/errors.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <string>

#include "apps/usage_error.h"
#include "core/config/config_error.h"
#include "core/evaluation/evaluation_error.h"
#include "core/io/errors.h"

namespace trajlo::python {
namespace {

namespace py = pybind11;

void Raise(const char* name, const std::string& message) {
  const py::object type = py::module_::import("trajlo.errors").attr(name);
  // Messages name paths, which need not be UTF-8.
  const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
      message.data(), static_cast<py::ssize_t>(message.size()), "backslashreplace"));
  PyErr_SetObject(type.ptr(), text.ptr());
}

/// Python's arguments have no dashes in front.
std::string WithoutDashes(const std::string& message) {
  return message.compare(0, 2, "--") == 0 ? message.substr(2) : message;
}

/// The flag of the commands is an argument here.
std::string WithArguments(std::string message) {
  const std::string flag = "add --overwrite";
  const std::size_t at = message.find(flag);
  return at == std::string::npos ? message
                                 : message.replace(at, flag.size(), "pass overwrite=True");
}

// The signature is pybind11's.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void Translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const ConfigError& error) {
    Raise("ConfigError", error.what());
  } catch (const InputError& error) {
    Raise("InputError", error.what());
  } catch (const DataError& error) {
    Raise("InputError", error.what());
  } catch (const OutputError& error) {
    Raise("OutputError", WithArguments(error.what()));
  } catch (const EvaluationError& error) {
    Raise("EvaluationError", error.what());
  } catch (const UsageError& error) {
    Raise("UsageError", WithoutDashes(error.what()));
  } catch (const StateError& error) {
    Raise("StateError", error.what());
  } catch (const EstimatorError& error) {
    Raise("EstimatorError", error.what());
  }
}

}  // namespace

void TranslateErrors() { py::register_local_exception_translator(Translate); }

}  // namespace trajlo::python
