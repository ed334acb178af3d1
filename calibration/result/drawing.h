// SPDX-License-Identifier: Apache-2.0
// Fields and curves as pictures of a page of HTML: PNG and SVG without any file beside it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/picture.h"

namespace aquarama::result {

// Values over the unrolled screen, top row first; not a number where there is none.
struct Field {
    glm::ivec2 sizePixels{};
    std::vector<double> values;

    // The value of a cell.
    [[nodiscard]] double& at(int x, int y) {
        return values[static_cast<std::size_t>(y * sizePixels.x + x)];
    }
};
// Without values.
[[nodiscard]] Field emptyField(glm::ivec2 sizePixels);
// Of those that are there; 0 where none is.
[[nodiscard]] double largestOf(const Field& field);

// Codes of sRGB at equal steps, linear between them.
using ColourScale = std::array<glm::vec3, 6>;
extern const ColourScale kGrowing;  // for amounts: dark blue to yellow, as matplotlib's viridis
extern const ColourScale kAround;   // for either side of a middle: blue, light grey, red
// Of a share, 0 to 1; shares outside are brought there.
[[nodiscard]] glm::vec3 colourAt(const ColourScale& scale, double share);
// "rgb(68 1 84)".
[[nodiscard]] std::string cssColour(glm::vec3 codes);

// The field with `low` and `high` at the ends of the scale, grey where it has no value.
[[nodiscard]] Picture colouredField(const Field& field,
                                    const ColourScale& scale,
                                    double low,
                                    double high);

// "data:image/png;base64,...".
[[nodiscard]] std::string dataUri(const Picture& picture);
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);
// With &, <, > and both quotes as HTML has them in text and attributes.
[[nodiscard]] std::string escaped(const std::string& text);

// Units of the SVG drawings; a panorama is as wide.
inline constexpr double kDrawingWidth = 1000;
// A picture over the whole width with an overlay of SVG elements in its units; `height` in them.
[[nodiscard]] std::string drawing(const Picture& picture,
                                  double height,
                                  const std::string& overlay,
                                  const std::string& title);
// A line through points, by a class of the page's style sheet and a colour.
[[nodiscard]] std::string line(const std::vector<glm::dvec2>& points, const std::string& colour);
// The bar that explains a field's colours, with the values at its ends.
[[nodiscard]] std::string scaleBar(const ColourScale& scale,
                                   const std::string& low,
                                   const std::string& high);

// A curve over equal steps from the left to the right edge of the wall.
struct Curve {
    std::string name, colour;
    std::vector<double> values;
};
// With an axis from 0 to `most`; `ticks` equal steps of it are labelled.
[[nodiscard]] std::string plot(const std::vector<Curve>& curves,
                               double most,
                               int ticks,
                               const std::string& title);

}  // namespace aquarama::result
