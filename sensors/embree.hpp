// Embree 3 and Embree 4, which differ in where the options of a query stand. Rays are packets
// of 16. `is_coherent`: they start together and go nearly the same way, which Embree may heed. In a
// portable world it may not: a component of a direction between -1e-18 and 0 then hides faces from
// the other rays of a packet.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace gnbv {

/// For lanes that are -1 in `valid`: tfar and hit become those of the first surface between tnear
/// and tfar.
inline void intersect16(const int* valid, RTCScene scene, RTCRayHit16& rays,
                        bool is_coherent = true) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments options;
  rtcInitIntersectArguments(&options);
  options.flags = is_coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &rays, &options);
#else
  RTCIntersectContext options;
  rtcInitIntersectContext(&options);
  options.flags =
      is_coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &options, &rays);
#endif
}

/// For lanes that are -1 in `valid`: tfar becomes -infinity where anything is between tnear and
/// tfar.
inline void occluded16(const int* valid, RTCScene scene, RTCRay16& rays, bool is_coherent = true) {
#if RTC_VERSION_MAJOR >= 4
  RTCOccludedArguments options;
  rtcInitOccludedArguments(&options);
  options.flags = is_coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcOccluded16(valid, scene, &rays, &options);
#else
  RTCIntersectContext options;
  rtcInitIntersectContext(&options);
  options.flags =
      is_coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcOccluded16(valid, scene, &options, &rays);
#endif
}

}  // namespace gnbv
