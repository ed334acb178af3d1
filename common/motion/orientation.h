// SPDX-License-Identifier: Apache-2.0
// Quaternions in the order of operations that every machine and instruction set shares: + - * / and
// sqrt only, so the vectorised step can be held to these bits. Rounding is to nearest even.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace aquarama::motion {

struct Quaternion {
    float w = 1.0F, x = 0.0F, y = 0.0F, z = 0.0F;
};

// Smallest three: the component of largest magnitude is left out and taken as positive.
struct PackedOrientation {
    std::array<std::int32_t, 3> abc{};
    std::uint8_t largest = 0;
};

inline constexpr float kOrientationUnitsPerOne = 741455.2F;  // 2^19 * sqrt(2)
inline constexpr float kOrientationUnit = 1.0F / kOrientationUnitsPerOne;
inline constexpr float kOrientationLimit = 524287.0F;  // 2^19 - 1, so that the sign may change

// Exact for |value| up to 2^51 and 2^22: the sum has no room for a fraction, so the processor
// rounds it away, to nearest even.
[[nodiscard]] inline double roundToEven(double value) {
    constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52
    return (value + kShift) - kShift;
}
[[nodiscard]] inline float roundToEven(float value) {
    constexpr float kShift = 12582912.0F;  // 1.5 * 2^23
    return (value + kShift) - kShift;
}

[[nodiscard]] inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
    return {(a.w * b.w - a.x * b.x) - (a.y * b.y + a.z * b.z),
            (a.w * b.x + a.x * b.w) + (a.y * b.z - a.z * b.y),
            (a.w * b.y + a.y * b.w) + (a.z * b.x - a.x * b.z),
            (a.w * b.z + a.z * b.w) + (a.x * b.y - a.y * b.x)};
}

[[nodiscard]] inline Quaternion conjugate(const Quaternion& q) {
    return {q.w, -q.x, -q.y, -q.z};
}

[[nodiscard]] inline Quaternion normalised(const Quaternion& q) {
    const float inverse = 1.0F / std::sqrt((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
    return {q.w * inverse, q.x * inverse, q.y * inverse, q.z * inverse};
}

// Of a quaternion within a few thousandths of unit length: one Newton step leaves 10^-6 of the
// error, without a square root or a division.
[[nodiscard]] inline Quaternion renormalised(const Quaternion& q) {
    const float inverse = 1.5F - 0.5F * ((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
    return {q.w * inverse, q.x * inverse, q.y * inverse, q.z * inverse};
}

[[nodiscard]] inline Quaternion unpack(const PackedOrientation& packed) {
    const float a = static_cast<float>(packed.abc[0]) * kOrientationUnit;
    const float b = static_cast<float>(packed.abc[1]) * kOrientationUnit;
    const float c = static_cast<float>(packed.abc[2]) * kOrientationUnit;
    const float squared = 1.0F - ((a * a + b * b) + c * c);
    const float most = std::sqrt(squared > 0.0F ? squared : 0.0F);
    switch (packed.largest) {
        case 0:
            return {most, a, b, c};
        case 1:
            return {a, most, b, c};
        case 2:
            return {a, b, most, c};
        default:
            return {a, b, c, most};
    }
}

[[nodiscard]] inline std::int32_t orientationUnits(float component) {
    const float units = component * kOrientationUnitsPerOne;
    const float bounded = units < -kOrientationLimit  ? -kOrientationLimit
                          : units > kOrientationLimit ? kOrientationLimit
                                                      : units;
    return static_cast<std::int32_t>(roundToEven(bounded));
}

// Of equally large components the first is left out.
[[nodiscard]] inline PackedOrientation pack(const Quaternion& q) {
    std::array<float, 4> c{q.w, q.x, q.y, q.z};
    std::uint8_t largest = 0;
    for (std::uint8_t i = 1; i < 4; ++i) {
        if (std::abs(c[i]) > std::abs(c[largest])) largest = i;
    }
    PackedOrientation packed{.largest = largest};
    const float sign = c[largest] < 0.0F ? -1.0F : 1.0F;
    std::size_t slot = 0;
    for (std::uint8_t i = 0; i < 4; ++i) {
        if (i != largest) packed.abc[slot++] = orientationUnits(sign * c[i]);
    }
    return packed;
}

}  // namespace aquarama::motion
