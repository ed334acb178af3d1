// SPDX-License-Identifier: Apache-2.0
// Included for each instruction set, after hwy/foreach_target.h: lanes of points.
#if defined(AQUARAMA_POINT_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef AQUARAMA_POINT_LANES_INL
#undef AQUARAMA_POINT_LANES_INL
#else
#define AQUARAMA_POINT_LANES_INL
#endif

#include <cstdint>

#include <hwy/highway.h>

#include "common/body/point_groups.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::body::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kPointGroup>;
using Ints = hn::RebindToSigned<Floats>;
using Lanes = hn::Vec<Floats>;
constexpr Floats kFloats;
constexpr Ints kInts;

// Writes lanes of x, y and z as points. Of the three vectors that come of it, vector j holds in
// lane l the axis (j N + l) mod 3 of point (j N + l) / 3.
class Interleave {
  public:
    HWY_INLINE Interleave() {
        const std::size_t lanes = hn::Lanes(kFloats);
        HWY_ALIGN std::int32_t point[kPointGroup];
        HWY_ALIGN std::int32_t axis[kPointGroup];
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t l = 0; l < lanes; ++l) {
                point[l] = static_cast<std::int32_t>((j * lanes + l) / 3);
                axis[l] = static_cast<std::int32_t>((j * lanes + l) % 3);
            }
            point_[j] = hn::SetTableIndices(kFloats, point);
            const auto axes = hn::Load(kInts, axis);
            isY_[j] = hn::RebindMask(kFloats, hn::Eq(axes, hn::Set(kInts, 1)));
            isZ_[j] = hn::RebindMask(kFloats, hn::Eq(axes, hn::Set(kInts, 2)));
        }
    }
    HWY_INLINE void store(Lanes x, Lanes y, Lanes z, float* points) const {
        for (std::size_t j = 0; j < 3; ++j) {
            Lanes v = hn::TableLookupLanes(x, point_[j]);
            v = hn::IfThenElse(isY_[j], hn::TableLookupLanes(y, point_[j]), v);
            v = hn::IfThenElse(isZ_[j], hn::TableLookupLanes(z, point_[j]), v);
            hn::StoreU(v, kFloats, points + j * hn::Lanes(kFloats));
        }
    }

  private:
    using Places = decltype(hn::SetTableIndices(Floats(), static_cast<std::int32_t*>(nullptr)));
    Places point_[3];
    hn::Mask<Floats> isY_[3];
    hn::Mask<Floats> isZ_[3];
};

}  // namespace
}  // namespace aquarama::body::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
