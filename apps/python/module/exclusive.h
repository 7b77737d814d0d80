// SPDX-License-Identifier: MIT
#pragma once

#include <thread>

#include "apps/python/module/errors.h"

namespace trajlo::python {

/// Says whether an object is computing. While it does, the GIL is released, so that another Python
/// thread, or a callback, could call into the same object. Members are called with the GIL held,
/// which is all the synchronisation they need.
class Exclusive {
 public:
  /// From its construction to its destruction the object computes. Throws StateError if it does so
  /// already.
  class Claim {
   public:
    explicit Claim(Exclusive* owner) : owner_(owner) {
      if (owner_->busy_) throw StateError(kMessage);
      owner_->busy_ = true;
      owner_->thread_ = std::this_thread::get_id();
    }
    ~Claim() { owner_->busy_ = false; }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

   private:
    Exclusive* owner_;
  };

  /// Reading is safe for the callbacks of the thread that computes. Throws StateError for others.
  void RequireReadable() const {
    if (busy_ && thread_ != std::this_thread::get_id()) throw StateError(kMessage);
  }

 private:
  static constexpr char kMessage[] =
      "this object is computing, in another thread or around the callback that was called; "
      "use it when that call has returned";

  bool busy_ = false;
  std::thread::id thread_;
};

}  // namespace trajlo::python
