// SPDX-License-Identifier: Apache-2.0
// A page of a PDF: lines, areas and a line of text. The only place that knows Cairo.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "drawings/layout.h"

namespace aquarama::drawings {

// How a line is drawn: its width in millimetres, and from 0 (black) to 1 (white).
struct Pen {
    double widthMillimetres = 0.3;
    double grey = 0;
    bool isClosed = false;
};

// Positions as on a sheet (layout.h).
class Page {
  public:
    explicit Page(glm::dvec2 sizeMillimetres);
    ~Page();
    Page(const Page&) = delete;
    Page& operator=(const Page&) = delete;

    // Through all points.
    void line(const std::vector<glm::dvec2>& points, const Pen& pen);
    // Only its line.
    void circle(glm::dvec2 centre, double radius, const Pen& pen);
    // A black square, by its upper left corner.
    void square(glm::dvec2 upperLeft, double side);
    // About a point of its base line; smaller where it would be wider than mostWidth.
    void text(glm::dvec2 middle, double height, double mostWidth, const std::string& text);
    // The file. Throws Error where Cairo has failed.
    [[nodiscard]] std::vector<std::byte> finish();

  private:
    struct Job;
    std::unique_ptr<Job> job_;
};

}  // namespace aquarama::drawings
