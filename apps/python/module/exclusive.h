// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "apps/python/module/errors.h"

namespace trajlo::python {

/// Says whether an object is computing. While it does, the GIL is released, so that another Python
/// thread, or a callback, could call into the same object. Members are called with the GIL held,
/// which guards all of them; the mutex only serves to wait.
///
/// One thread computes, a second one that wants to is refused. Others that read wait until the call
/// has returned, or until it calls back: the state is whole then, and a callback may well wait for
/// them.
class Exclusive {
 public:
  /// From its construction to its destruction the object computes. Throws StateError if it does so
  /// already.
  class Claim {
   public:
    explicit Claim(Exclusive* owner) : owner_(owner) {
      owner_->RequireIdle();
      // Those who waited during the last call would miss the short time until the next, always.
      while (owner_->waiting_ > 0) owner_->Wait();
      owner_->RequireIdle();
      owner_->busy_ = true;
    }
    ~Claim() {
      owner_->busy_ = false;
      owner_->Notify();
    }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

   private:
    Exclusive* owner_;
  };

  /// While a callback of the computing thread runs. It begins and ends with the GIL held.
  class CallingBack {
   public:
    explicit CallingBack(Exclusive* owner) : owner_(owner) {
      owner_->calling_back_ = true;
      owner_->Notify();
    }
    ~CallingBack() { owner_->calling_back_ = false; }
    CallingBack(const CallingBack&) = delete;
    CallingBack& operator=(const CallingBack&) = delete;

   private:
    Exclusive* owner_;
  };

  /// Returns when the state can be read, which stays so as long as the GIL is held. Throws what
  /// Python's signals throw, such as KeyboardInterrupt.
  void AwaitReadable() const {
    const Waiting waiting(this);
    while (busy_ && !calling_back_) {
      Wait();
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    }
  }

 private:
  class Waiting {
   public:
    explicit Waiting(const Exclusive* owner) : owner_(owner) { ++owner_->waiting_; }
    ~Waiting() {
      --owner_->waiting_;
      owner_->Notify();
    }
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

   private:
    const Exclusive* owner_;
  };

  void RequireIdle() const {
    if (!busy_) return;
    throw StateError(
        "this object is computing, in another thread or around the callback that was called; "
        "use it when that call has returned");
  }

  /// Gives the GIL away until something changes, or for a moment. It is taken back without the
  /// mutex, for which a thread that has the GIL may be waiting.
  void Wait() const {
    std::unique_lock<std::mutex> lock(mutex_);
    const pybind11::gil_scoped_release release;
    changed_.wait_for(lock, std::chrono::milliseconds(50));
    lock.unlock();
  }
  void Notify() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    changed_.notify_all();
  }

  bool busy_ = false;
  bool calling_back_ = false;
  mutable int waiting_ = 0;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
};

}  // namespace trajlo::python
