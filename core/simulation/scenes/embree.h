// SPDX-License-Identifier: MIT
#pragma once

// Embree 3 or 4: they differ in one call. The build says which one it found.
#if TRAJLO_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace trajlo::simulation {

/// Fills query->hit with the first triangle that the ray meets, and its tfar with the distance.
inline void Intersect(RTCScene scene, RTCRayHit* query) {
#if TRAJLO_EMBREE_MAJOR >= 4
  rtcIntersect1(scene, query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, query);
#endif
}

}  // namespace trajlo::simulation
