// SPDX-License-Identifier: Apache-2.0
// The forms of swimming: what the midlines and the pectoral fins of captured gaits show, and which
// form that is. Lengths are body lengths, angles radians; pure functions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/motion/repertoire.h"

namespace aquarama::report {

// What one cycle of straight swimming shows. All of it is measured on the nodal points and the fin
// poses; a beat that the cycle holds twice counts twice. Swings are peak to peak, across the
// course.
struct FormFigures {
    double speed = 0;  // body lengths a second

    // The body.
    double tailHertz = 0;   // beats of the tail a second; 0 where it is still
    double stride = 0;      // body lengths in a beat of the tail; where it is still, of the fins
    double tail = 0;        // swing of the tail
    double head = 0;        // swing of the nose
    double least = 0;       // the least swing of any part
    double leastAt = 0;     // where that is, as a share of the length, from the nose
    double swinging = 0;    // share of the length, at the tail, that swings over half as far as it
    double headYaw = 0;     // swing of the direction of the head, from ring 1 to the nose
    double wavelength = 0;  // of the body wave; 0 where the tail is still
    double strouhal = 0;    // tailHertz * tail / speed

    // The pectoral fins, the mean of both.
    double finHertz = 0;   // strokes a second; 0 where they are still
    double finStroke = 0;  // angle of the stroke, peak to peak
    double finsApart = 0;  // phase between left and right stroke, 0 (together) to pi (in turn)
};
// `gait` swims straight on, forward.
[[nodiscard]] FormFigures formFigures(const motion::ActionSegment& gait);

// What drives a gait. The bounds are in forms.cpp, with their sources.
[[nodiscard]] bool isRowed(const FormFigures& gait);    // the fins, and the body is still
[[nodiscard]] bool beatsTail(const FormFigures& gait);  // the tail, and the fins are still

// The forms, after Breder 1926 and Lindsey 1978.
enum class SwimmingForm {
    Labriform,    // rows with a still body when slow, beats the tail when fast
    StiffBodied,  // beats the tail; less than the last fifth swings
    Carangiform,  // beats the tail; more than that swings, the head is steady
    HeadYawing,   // beats the tail; more than that swings, and the head yaws
};
[[nodiscard]] const char* nameOf(SwimmingForm form);  // "labriform", ...
// Of a fish that swims slowly and fast like that; none for a fish that is of none of these forms.
[[nodiscard]] std::optional<SwimmingForm> formOf(const FormFigures& slow, const FormFigures& fast);

// The data of the sheet as JSON text, which draw_forms.py beside this file reads: of each species
// its form, and of its slow and fast gait the figures, midlines, swing and strokes.
[[nodiscard]] std::string formsData(const std::vector<motion::Repertoire>& repertoires);

}  // namespace aquarama::report
