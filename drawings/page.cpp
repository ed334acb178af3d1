// SPDX-License-Identifier: Apache-2.0
#include "drawings/page.h"

#include <algorithm>
#include <numbers>
#include <span>

#include <cairo-pdf.h>
#include <cairo.h>

#include "common/base/log.h"

namespace aquarama::drawings {

namespace {

constexpr double kPointsPerMillimetre = 72 / 25.4;

// Cairo's callback: appends to the file. No exception may pass through the library.
cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
    try {
        const auto more = std::as_bytes(std::span(data, length));
        auto& file = *static_cast<std::vector<std::byte>*>(closure);
        file.insert(file.end(), more.begin(), more.end());
        return CAIRO_STATUS_SUCCESS;
    } catch (const std::bad_alloc&) {
        return CAIRO_STATUS_NO_MEMORY;
    }
}

}  // namespace

struct Page::Job {
    std::vector<std::byte> file;
    cairo_surface_t* surface = nullptr;
    cairo_t* cairo = nullptr;
};

Page::Page(glm::dvec2 sizeMillimetres) : job_{std::make_unique<Job>()} {
    const glm::dvec2 points = kPointsPerMillimetre * sizeMillimetres;
    job_->surface = cairo_pdf_surface_create_for_stream(append, &job_->file, points.x, points.y);
    job_->cairo = cairo_create(job_->surface);
    cairo_translate(job_->cairo, points.x / 2, points.y / 2);
    cairo_scale(job_->cairo, kPointsPerMillimetre, -kPointsPerMillimetre);
    cairo_set_line_join(job_->cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(job_->cairo, CAIRO_LINE_CAP_ROUND);
}

Page::~Page() {
    cairo_destroy(job_->cairo);
    cairo_surface_destroy(job_->surface);
}

void Page::line(const std::vector<glm::dvec2>& points, const Pen& pen) {
    for (const glm::dvec2 at : points) cairo_line_to(job_->cairo, at.x, at.y);
    if (pen.isClosed) cairo_close_path(job_->cairo);
    cairo_set_line_width(job_->cairo, pen.widthMillimetres);
    cairo_set_source_rgb(job_->cairo, pen.grey, pen.grey, pen.grey);
    cairo_stroke(job_->cairo);
}

void Page::circle(glm::dvec2 centre, double radius, const Pen& pen) {
    cairo_new_sub_path(job_->cairo);
    cairo_arc(job_->cairo, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
    line({}, pen);
}

void Page::square(glm::dvec2 upperLeft, double side) {
    cairo_set_source_rgb(job_->cairo, 0, 0, 0);
    cairo_rectangle(job_->cairo, upperLeft.x, upperLeft.y, side, -side);
    cairo_fill(job_->cairo);
}

void Page::text(glm::dvec2 middle, double height, double mostWidth, const std::string& text) {
    cairo_t* cairo = job_->cairo;
    cairo_save(cairo);
    cairo_translate(cairo, middle.x, middle.y);
    cairo_scale(cairo, 1, -1);
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, height);
    cairo_text_extents_t extents{};
    cairo_text_extents(cairo, text.c_str(), &extents);
    const double shrink = std::min(1.0, mostWidth / std::max(extents.width, 1.0));
    cairo_scale(cairo, shrink, shrink);
    cairo_set_source_rgb(cairo, 0.25, 0.25, 0.25);
    cairo_move_to(cairo, -extents.width / 2 - extents.x_bearing, 0);
    cairo_show_text(cairo, text.c_str());
    cairo_restore(cairo);
}

std::vector<std::byte> Page::finish() {
    cairo_show_page(job_->cairo);
    cairo_surface_finish(job_->surface);
    const cairo_status_t status = cairo_surface_status(job_->surface);
    if (status != CAIRO_STATUS_SUCCESS)
        throw Error(std::string("a sheet cannot be drawn (") + cairo_status_to_string(status) +
                    "); free some memory");
    return std::move(job_->file);
}

}  // namespace aquarama::drawings
