// SPDX-License-Identifier: MIT
#pragma once

namespace trajlo::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // gcc
#define TRAJLO_TESTS_ARE_SANITIZED
#elif defined(__has_feature)  // clang; libraries define it for gcc, too
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TRAJLO_TESTS_ARE_SANITIZED
#endif
#endif

/// Whether the sanitizer of addresses or that of threads is at work. Both hold much memory.
#ifdef TRAJLO_TESTS_ARE_SANITIZED
inline constexpr bool kSanitized = true;
#undef TRAJLO_TESTS_ARE_SANITIZED
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace trajlo::testing
