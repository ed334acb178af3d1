// SPDX-License-Identifier: Apache-2.0
// Packets as trackers send them, written by program.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/common/osc/sample_packets.h"

namespace aquarama::test {

// Big-endian.
inline std::string oscNumber(float value) {
    return oscWord(std::bit_cast<std::uint32_t>(value));
}

// A touch of a stream; the other values that TUIO has are zero.
struct SampleTouch {
    std::uint32_t session = 0;
    float x = 0, y = 0, speedX = 0, speedY = 0;
};

// A frame of TUIO 1.1: /tuio/2Dcur, or /tuio/2Dblb where `isBlob`. All touches are alive.
inline std::string tuioFrame(std::uint32_t number,
                             const std::vector<SampleTouch>& touches,
                             const std::string& source = "",
                             bool isBlob = false) {
    const std::string kind = isBlob ? "/tuio/2Dblb" : "/tuio/2Dcur";
    std::vector<std::string> parts;
    if (!source.empty())
        parts.push_back(oscMessage(kind, "ss", oscText("source") + oscText(source)));
    std::string alive = oscText("alive");
    for (const SampleTouch& one : touches) alive += oscWord(one.session);
    parts.push_back(oscMessage(kind, "s" + std::string(touches.size(), 'i'), alive));
    for (const SampleTouch& one : touches) {
        const std::string shape =
            isBlob ? oscNumber(0) + oscNumber(0) + oscNumber(0) + oscNumber(0) : "";
        const std::string place =
            oscWord(one.session) + oscNumber(one.x) + oscNumber(one.y) + shape;
        const std::string speed = oscNumber(one.speedX) + oscNumber(one.speedY);
        const std::string rest = isBlob ? oscNumber(0) + oscNumber(0) + oscNumber(0) : oscNumber(0);
        parts.push_back(oscMessage(
            kind, isBlob ? "sifffffffffff" : "sifffff", oscText("set") + place + speed + rest));
    }
    parts.push_back(oscMessage(kind, "si", oscText("fseq") + oscWord(number)));
    return oscBundle(parts);
}

// A frame of TUIO 2.0 by pointers, or by bounds where `isBlob`.
inline std::string tuio2Frame(std::uint32_t number,
                              const std::vector<SampleTouch>& touches,
                              const std::string& source = "tracker",
                              bool isBlob = false) {
    std::vector<std::string> parts{
        oscMessage("/tuio2/frm",
                   "itis",
                   oscWord(number) + oscWord(7) + oscWord(0) + oscWord(0) + oscText(source))};
    std::string alive;
    const std::string zero = oscNumber(0);
    for (const SampleTouch& one : touches) {
        const std::string place = oscNumber(one.x) + oscNumber(one.y);
        const std::string rest = zero + zero + zero + zero + oscNumber(one.speedX) +
                                 oscNumber(one.speedY) + zero + zero + zero;
        if (isBlob)
            parts.push_back(
                oscMessage("/tuio2/bnd", "ifffffffffff", oscWord(one.session) + place + rest));
        else
            parts.push_back(
                oscMessage("/tuio2/ptr",
                           "iiifffffffffff",
                           oscWord(one.session) + oscWord(0) + oscWord(0) + place + rest));
        alive += oscWord(one.session);
    }
    parts.push_back(oscMessage("/tuio2/alv", std::string(touches.size(), 'i'), alive));
    return oscBundle(parts);
}

}  // namespace aquarama::test
