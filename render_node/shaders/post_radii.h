// SPDX-License-Identifier: Apache-2.0
// How far the passes over a picture reach, radians: included by C++ and by GLSL. A channel draws a
// margin of at least kPostReach about what its projector shows (channel_picture.cpp), so that
// neighbours soften and bloom alike where they overlap.
#ifndef AQUARAMA_POST_RADII_H
#define AQUARAMA_POST_RADII_H
#ifdef __cplusplus
namespace aquarama::shaders {
inline constexpr float
#else
const float
#endif
    // Water scatters by sigma = 0.0016 sqrt(r) rad over r metres; taps go to two sigma.
    kScatterSigma = 0.0016F,
    kScatterMostSigma = 0.0080F,
    // The glow about what is bright: rings of taps of so wide a mean.
    kBloomNear = 0.0035F, kBloomFar = 0.0095F, kPostReach = 0.0170F;
#ifdef __cplusplus
}  // namespace aquarama::shaders
#endif
#endif
