// SPDX-License-Identifier: Apache-2.0
#include "capture/step_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/step_lanes.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aquarama::capture::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, kMostDoubles>;
using Lanes = hn::Vec<Doubles>;
constexpr Doubles kDoubles;

HWY_INLINE Lanes all(double value) {
    return hn::Set(kDoubles, value);
}

// One vector in space for each lane; products and sums in the order in which glm has them.
struct SpaceLanes {
    Lanes x, y, z;
};

HWY_INLINE SpaceLanes operator+(const SpaceLanes& a, const SpaceLanes& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE SpaceLanes operator-(const SpaceLanes& a, const SpaceLanes& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE SpaceLanes scaled(const SpaceLanes& v, Lanes by) {
    return {hn::Mul(v.x, by), hn::Mul(v.y, by), hn::Mul(v.z, by)};
}
HWY_INLINE SpaceLanes divided(const SpaceLanes& v, Lanes by) {
    return {hn::Div(v.x, by), hn::Div(v.y, by), hn::Div(v.z, by)};
}
HWY_INLINE Lanes dot(const SpaceLanes& a, const SpaceLanes& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Lanes length(const SpaceLanes& v) {
    return hn::Sqrt(dot(v, v));
}
HWY_INLINE SpaceLanes cross(const SpaceLanes& a, const SpaceLanes& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

template <class Columns>
HWY_INLINE SpaceLanes loaded(const Columns& columns, std::size_t i) {
    return {hn::LoadU(kDoubles, &columns.x[i]),
            hn::LoadU(kDoubles, &columns.y[i]),
            hn::LoadU(kDoubles, &columns.z[i])};
}
template <class Columns>
HWY_INLINE void store(const SpaceLanes& v, Columns& columns, std::size_t i) {
    hn::StoreU(v.x, kDoubles, &columns.x[i]);
    hn::StoreU(v.y, kDoubles, &columns.y[i]);
    hn::StoreU(v.z, kDoubles, &columns.z[i]);
}

}  // namespace

void pullLanes(UnitColumns& units, double damping, double halfStep) {
    const Lanes half = all(halfStep);
    for (std::size_t i = 0; i < kUnits; i += hn::Lanes(kDoubles)) {
        const SpaceLanes r = loaded(units.offset, i);
        const SpaceLanes v = loaded(units.rate, i);
        const Lanes stiffness = hn::LoadU(kDoubles, &units.stiffness[i]);
        const Lanes rest = hn::LoadU(kDoubles, &units.restLength[i]);
        const SpaceLanes moves = scaled(v, half);
        const Lanes ends = hn::Div(hn::Add(length(r - moves), length(r + moves)), all(2));
        const Lanes distance = length(r);
        const SpaceLanes u = divided(r, distance);
        const Lanes tension = hn::Mul(stiffness, hn::Sub(all(1), hn::Div(rest, ends)));
        const Lanes rate = hn::Div(hn::Mul(all(damping), dot(u, v)), distance);
        const Lanes geometric = hn::Max(all(0), tension);
        store(u, units.direction, i);
        hn::StoreU(hn::Add(hn::Mul(half, hn::Sub(stiffness, geometric)), all(damping)),
                   kDoubles,
                   &units.along[i]);
        hn::StoreU(hn::Mul(half, geometric), kDoubles, &units.across[i]);
        hn::StoreU(hn::Add(tension, rate), kDoubles, &units.pull[i]);
    }
}

void resistLanes(FaceColumns& faces) {
    for (std::size_t i = 0; i < kDragFaces; i += hn::Lanes(kDoubles)) {
        const SpaceLanes area =
            divided(cross(loaded(faces.second, i), loaded(faces.third, i)), all(2));
        const SpaceLanes velocity = divided(loaded(faces.velocities, i), all(3));
        const Lanes flow = dot(area, velocity);
        const Lanes third = hn::Div(hn::LoadU(kDoubles, &faces.drag[i]), all(3));
        store(area, faces.area, i);
        hn::StoreU(flow, kDoubles, &faces.flow[i]);
        store(scaled(area, hn::Div(hn::Mul(third, flow), dot(area, area))), faces.scaled, i);
    }
}

namespace {

// Eliminates the unknowns row to row + count - 1, whose pivots are inverted, from the row `target`.
// `end` is one past the last column of the rows. A whole vector may reach behind it, where the
// sources are zero.
template <std::size_t count>
HWY_INLINE void subtract(EnvelopeRows& system,
                         std::size_t row,
                         std::size_t target,
                         std::size_t end) {
    const double* sources[count];
    Lanes factors[count];
    for (std::size_t i = 0; i < count; ++i) {
        sources[i] = system.matrix[row + i].data() + (target - row - i);
        const double factor = sources[i][0] * system.matrix[row + i][0];
        system.right[target] -= factor * system.right[row + i];
        factors[i] = all(factor);
    }
    double* const elements = system.matrix[target].data();
    for (std::size_t k = 0; k < end - target; k += hn::Lanes(kDoubles)) {
        Lanes element = hn::LoadU(kDoubles, elements + k);
        for (std::size_t i = 0; i < count; ++i)
            element = hn::Sub(element, hn::Mul(factors[i], hn::LoadU(kDoubles, sources[i] + k)));
        hn::StoreU(element, kDoubles, elements + k);
    }
}

HWY_INLINE void invertPivot(EnvelopeRows& system, std::size_t row) {
    system.matrix[row][0] = 1 / system.matrix[row][0];
}

}  // namespace

void eliminateLanes(EnvelopeRows& system) {
    for (std::size_t row = 0; row < EnvelopeRows::kUnknowns; row += 3) {
        const std::size_t end = endOfRows(row / 3);
        invertPivot(system, row);
        subtract<1>(system, row, row + 1, end);
        invertPivot(system, row + 1);
        subtract<2>(system, row, row + 2, end);
        invertPivot(system, row + 2);
        for (std::size_t target = row + 3; target < end; ++target)
            subtract<3>(system, row, target, end);
    }
}

}  // namespace aquarama::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama::capture {

HWY_EXPORT(pullLanes);
HWY_EXPORT(resistLanes);
HWY_EXPORT(eliminateLanes);

void pullUnits(UnitColumns& units, double damping, double halfStepSeconds) {
    HWY_DYNAMIC_DISPATCH(pullLanes)(units, damping, halfStepSeconds);
}

void resistFaces(FaceColumns& faces) {
    HWY_DYNAMIC_DISPATCH(resistLanes)(faces);
}

void eliminate(EnvelopeRows& system) {
    HWY_DYNAMIC_DISPATCH(eliminateLanes)(system);
}

}  // namespace aquarama::capture
#endif
