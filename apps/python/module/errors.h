// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace trajlo::python {

/// Arrays or scans that cannot be used; becomes trajlo.InputError.
class DataError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An object that is used at the wrong time; becomes trajlo.StateError.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The estimator threw; becomes trajlo.EstimatorError.
class EstimatorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From now on each C++ exception becomes its class of trajlo.errors, with the same message.
void TranslateErrors();

}  // namespace trajlo::python
