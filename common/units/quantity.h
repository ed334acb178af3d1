// SPDX-License-Identifier: Apache-2.0
// Numbers that know their unit, for what crosses function boundaries. Hot arrays stay float with
// the unit in the name.
#pragma once

#include <compare>

namespace aquarama {

// Different tags never mix; only scaling by a plain number is free.
template <class Tag, class Rep = double>
struct Quantity {
    Rep value{};

    friend constexpr Quantity operator+(Quantity a, Quantity b) { return {a.value + b.value}; }
    friend constexpr Quantity operator-(Quantity a, Quantity b) { return {a.value - b.value}; }
    friend constexpr Quantity operator*(Quantity a, Rep scale) { return {a.value * scale}; }
    friend constexpr Rep operator/(Quantity a, Quantity b) { return a.value / b.value; }
    friend constexpr auto operator<=>(Quantity, Quantity) = default;
};

using Metres = Quantity<struct MetresTag>;
using Radians = Quantity<struct RadiansTag>;
using Seconds = Quantity<struct SecondsTag>;
using BodyLengths = Quantity<struct BodyLengthsTag>;

}  // namespace aquarama
