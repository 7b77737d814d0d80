// SPDX-License-Identifier: MIT
#include "apps/interrupt.h"

#include <csignal>

namespace trajlo {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not wait for a lock");

void OnSignal(int) { interrupted = true; }

void SetHandlers() {
  struct sigaction action {};
  action.sa_handler = OnSignal;
  // Once: the next signal finds the default again. Restart: reads and writes are not cut short.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup wins.
}

}  // namespace

const std::atomic<bool>& HandleInterrupts() {
  static const bool once = (SetHandlers(), true);
  static_cast<void>(once);
  return interrupted;
}

}  // namespace trajlo
