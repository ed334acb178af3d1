// SPDX-License-Identifier: Apache-2.0
// Shared by the readers of meshes: conversion of meshes to warps, and parsers of text and binary
// files.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/base/characters.h"
#include "common/base/log.h"
#include "common/formats/archive.h"
#include "common/formats/vendors.h"

namespace aquarama::formats {

namespace {

// How far a node may be from its even place: files are rounded to 6 digits.
constexpr double kEvenWithin = 1e-5;
// Weights of a triangle's corners may be this much below zero, so that no sample falls between two.
constexpr double kEdgeSlack = 1e-9;
// The boxes around a mesh's triangles may cover the picture this many times.
constexpr double kMostLayers = 16;
// Samples of a mask in each cell of a grid each way, where the picture's size is not known.
constexpr double kLightPerCell = 8;
constexpr double kMostMaskSide = 2048;
// The largest number of a file: differences of larger coordinates would lose all digits.
constexpr double kLargest = 1e9;

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

// The samples, both inclusive, that a triangle may hold. Empty where last < first.
struct SampleBox {
    glm::ivec2 first{0}, last{-1};
    [[nodiscard]] double count() const {
        const glm::dvec2 size = glm::max(glm::dvec2(last - first + 1), 0.0);
        return size.x * size.y;
    }
};

// Corners in samples: sample c has its centre at c.
using Corners = std::array<glm::dvec2, 3>;

Corners cornersOf(const WarpMesh& mesh, const std::array<std::uint32_t, 3>& t, glm::ivec2 size) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = mesh.vertices[t[i]].place * glm::dvec2(size) - 0.5;
    return corners;
}

SampleBox boxOf(const Corners& corners, glm::ivec2 size) {
    const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    if (!(low.x <= high.x && low.y <= high.y)) return {};
    const glm::dvec2 last(size - 1);
    return {glm::ivec2(glm::clamp(glm::ceil(low - 1e-6), glm::dvec2(0), last + 1.0)),
            glm::ivec2(glm::clamp(glm::floor(high + 1e-6), glm::dvec2(-1), last))};
}

// The weights of the corners at a place; the area is twice the triangle's, signed.
glm::dvec3 weightsAt(const Corners& corners, double area, glm::dvec2 place) {
    const double second = cross(place - corners[0], corners[2] - corners[0]) / area;
    const double third = cross(corners[1] - corners[0], place - corners[0]) / area;
    return {1 - second - third, second, third};
}

struct Raster {
    const WarpMesh& mesh;
    Warp& warp;
    Mask* light;

    void set(std::size_t sample, const std::array<std::uint32_t, 3>& t, glm::dvec3 weights) const {
        glm::dvec3 target(0);
        double bright = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const WarpMesh::Vertex& vertex = mesh.vertices[t[i]];
            const double weight = weights[static_cast<int>(i)];
            target += weight * vertex.target;
            bright += weight * vertex.light;
        }
        warp.samples[sample] = glm::vec3(target);
        if (light != nullptr)
            light->codes[sample] =
                static_cast<std::uint16_t>(std::lround(65535 * std::clamp(bright, 0.0, 1.0)));
    }

    void draw(const std::array<std::uint32_t, 3>& t) const {
        const Corners corners = cornersOf(mesh, t, warp.size);
        const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!std::isfinite(area) || area == 0) return;
        const SampleBox box = boxOf(corners, warp.size);
        for (int y = box.first.y; y <= box.last.y; ++y)
            for (int x = box.first.x; x <= box.last.x; ++x) {
                const glm::dvec3 weights = weightsAt(corners, area, {x, y});
                if (!(std::min({weights.x, weights.y, weights.z}) >= -kEdgeSlack)) continue;
                set(static_cast<std::size_t>(y) * static_cast<std::size_t>(warp.size.x) +
                        static_cast<std::size_t>(x),
                    t,
                    weights);
            }
    }
};

std::size_t pixelsOf(glm::ivec2 size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

// Whether the triangles cover each of so many cells of the picture once.
bool coversOnce(const WarpMesh& mesh, std::size_t cells, double cellArea) {
    double area = 0;
    std::size_t count = 0;
    for (const auto& t : mesh.triangles) {
        const Corners corners = cornersOf(mesh, t, {1, 1});
        const double twice = std::abs(cross(corners[1] - corners[0], corners[2] - corners[0]));
        area += twice / 2;
        // Strips turn with triangles that have no area.
        if (twice > cellArea / 2) ++count;
    }
    return count == 2 * cells && std::abs(area - static_cast<double>(cells) * cellArea) < 1e-3;
}

// The cells of a grid of samples whose four corners are lit.
std::size_t litCells(const Warp& warp) {
    const auto columns = static_cast<std::size_t>(warp.size.x);
    const auto lit = [&](std::size_t i) { return !std::isnan(warp.samples[i].x); };
    std::size_t count = 0;
    for (std::size_t i = 0; i + columns + 1 < warp.samples.size(); ++i) {
        const std::array corners{i, i + 1, i + columns, i + columns + 1};
        const bool lastOfRow = (i + 1) % columns == 0;
        if (!lastOfRow && std::ranges::all_of(corners, lit)) ++count;
    }
    return count;
}

// The vertices as a grid of rows from the top, each from the left; empty where they form no grid.
struct OrderedGrid {
    std::size_t columns = 0, rows = 0;
    std::vector<std::uint32_t> order;
};

OrderedGrid orderedGrid(const WarpMesh& mesh) {
    OrderedGrid grid;
    const auto x = [&](std::uint32_t i) { return mesh.vertices[i].place.x; };
    const auto y = [&](std::uint32_t i) { return mesh.vertices[i].place.y; };
    grid.order.resize(mesh.vertices.size());
    std::iota(grid.order.begin(), grid.order.end(), 0U);
    std::ranges::sort(grid.order, {}, y);
    const auto second = std::ranges::find_if(
        grid.order, [](double down) { return down > kEvenWithin; }, y);
    grid.columns = static_cast<std::size_t>(second - grid.order.begin());
    if (grid.columns < 2 || grid.order.size() % grid.columns != 0) return {};
    grid.rows = grid.order.size() / grid.columns;
    for (auto row = grid.order.begin(); row != grid.order.end();) {
        const auto end = row + static_cast<std::ptrdiff_t>(grid.columns);
        std::ranges::sort(row, end, {}, x);
        row = end;
    }
    return grid.rows < 2 ? OrderedGrid{} : grid;
}

// The vertices as samples from border to border; nothing where they are not at these places.
std::optional<Warp> nodesOf(const WarpMesh& mesh) {
    const OrderedGrid grid = orderedGrid(mesh);
    if (grid.columns == 0) return {};
    Warp warp{{static_cast<int>(grid.columns), static_cast<int>(grid.rows)}, Sampling::Nodes, {}};
    const glm::dvec2 last(warp.size - 1);
    warp.samples.reserve(grid.order.size());
    for (std::size_t i = 0; i < grid.order.size(); ++i) {
        const WarpMesh::Vertex& vertex = mesh.vertices[grid.order[i]];
        const glm::dvec2 even = glm::dvec2(i % grid.columns, i / grid.columns) / last;
        const glm::dvec2 off = glm::abs(vertex.place - even);
        if (!(off.x <= kEvenWithin && off.y <= kEvenWithin)) return {};
        warp.samples.emplace_back(vertex.target);
    }
    if (!coversOnce(mesh, litCells(warp), 1 / (last.x * last.y))) return {};
    return warp;
}

// The number of samples that keeps light linear within the cells of the grid.
glm::ivec2 maskSize(const Warp& nodes) {
    const auto side = [](int count) {
        return static_cast<int>(
            std::min(kMostMaskSide, static_cast<double>(count - 1) * kLightPerCell));
    };
    return {side(nodes.size.x), side(nodes.size.y)};
}

void refuseLayers(const WarpMesh& mesh, glm::ivec2 size, const std::string& source) {
    double covered = 0;
    for (const auto& t : mesh.triangles) covered += boxOf(cornersOf(mesh, t, size), size).count();
    if (covered > kMostLayers * static_cast<double>(pixelsOf(size)))
        throw Error(source + ": its triangles cover the picture more than " +
                    std::to_string(static_cast<int>(kMostLayers)) +
                    " times over; export the mesh anew");
}

glm::ivec2 wantedSize(const FileChannel& channel, const std::string& source) {
    const glm::ivec2 size = channel.sizePixels;
    if (size == glm::ivec2(0))
        throw Error(source +
                    ": its mesh is uneven and it does not say how many pixels the projector has; "
                    "give --size WIDTHxHEIGHT");
    if (!pictureSize(size.x, size.y))
        throw Error(source + ": no picture has " + std::to_string(size.x) + " by " +
                    std::to_string(size.y) + " pixels; give --size WIDTHxHEIGHT");
    return size;
}

Warp atPictureSize(const FileChannel& channel,
                   const WarpMesh& mesh,
                   const std::string& source,
                   Mask* light) {
    const glm::ivec2 size = wantedSize(channel, source);
    refuseLayers(mesh, size, source);
    return rasterised(mesh, size, light);
}

// The blend, and the warp where it has none: an even mesh needs no picture's size for either.
void addLight(FileChannel& channel,
              const WarpMesh& mesh,
              const std::string& source,
              double lightGamma) {
    Mask light;
    if (channel.warp && channel.sizePixels == glm::ivec2(0)) {
        static_cast<void>(rasterised(mesh, maskSize(*channel.warp), &light));
    } else {
        Warp warp = atPictureSize(channel, mesh, source, &light);
        if (!channel.warp) channel.warp = std::move(warp);
    }
    light.gamma = lightGamma;
    channel.blend = std::move(light);
}

}  // namespace

Warp rasterised(const WarpMesh& mesh, glm::ivec2 size, Mask* light) {
    Warp warp{size, Sampling::Centres, {}};
    warp.samples.assign(pixelsOf(size), glm::vec3(kUnlit));
    if (light != nullptr) {
        *light = {size, 1, 16, 1, {}};
        light->codes.assign(pixelsOf(size), 0);
    }
    const Raster raster{mesh, warp, light};
    for (const auto& triangle : mesh.triangles) raster.draw(triangle);
    return warp;
}

std::optional<glm::ivec2> pictureSize(double width, double height) {
    const auto side = [](double pixels) {
        return pixels >= 1 && pixels <= static_cast<double>(kMostPictureSide) &&
               pixels == std::floor(pixels);
    };
    if (!side(width) || !side(height)) return {};
    if (width * height > static_cast<double>(kMostPicturePixels)) return {};
    return glm::ivec2(static_cast<int>(width), static_cast<int>(height));
}

std::string stemOf(const std::string& path) {
    const std::string file = path.substr(path.find_last_of('/') + 1);
    return file.substr(0, file.find_last_of('.'));
}

WallFile oneChannel(Profile profile, FileChannel channel) {
    WallFile file;
    file.profile = profile;
    file.channels.push_back(std::move(channel));
    return file;
}

std::string frustumPathBeside(const std::string& path) {
    constexpr std::string_view kMesh = "_mesh";
    std::string stem = stemOf(path);
    if (stem.ends_with(kMesh)) stem.resize(stem.size() - kMesh.size());
    return path.substr(0, path.find_last_of('/') + 1) + stem + "_frustum.csv";
}

// camera_to_world = Ry(-yaw) Rx(pitch) Rz(-roll).
Frustum turned(double x, double y, double z, double w) {
    const glm::dmat3 world = glm::mat3_cast(glm::dquat(w, x, y, z));
    const glm::dvec3 right = world[0], up = world[1], forward = -world[2];
    Frustum frustum;
    frustum.pitch = std::asin(std::clamp(forward.y, -1.0, 1.0));
    const bool level = std::hypot(forward.x, forward.z) > 1e-6;
    // Straight up or down, yaw and roll are the same rotation.
    frustum.yaw = level ? std::atan2(forward.x, -forward.z) : std::atan2(right.z, right.x);
    frustum.roll = level ? -std::atan2(right.y, up.y) : 0;
    return frustum;
}

std::vector<std::array<std::uint32_t, 3>> gridTriangles(std::size_t columns, std::size_t rows) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(2 * (columns - 1) * (rows - 1));
    for (std::size_t row = 0; row + 1 < rows; ++row)
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const auto corner = static_cast<std::uint32_t>(row * columns + column);
            const auto below = static_cast<std::uint32_t>(corner + columns);
            triangles.push_back({corner, corner + 1, below + 1});
            triangles.push_back({corner, below + 1, below});
        }
    return triangles;
}

void addMesh(FileChannel& channel,
             WarpMesh mesh,
             const std::string& source,
             const ReadOptions& options,
             std::optional<double> lightGamma) {
    if (options.upsideDown)
        for (WarpMesh::Vertex& vertex : mesh.vertices) vertex.place.y = 1 - vertex.place.y;
    if (options.sizePixels) channel.sizePixels = *options.sizePixels;
    channel.warp = nodesOf(mesh);
    if (lightGamma)
        addLight(channel, mesh, source, *lightGamma);
    else if (!channel.warp)
        channel.warp = atPictureSize(channel, mesh, source, nullptr);
}

std::string_view beginning(std::span<const std::byte> bytes, std::size_t most) {
    // Bytes may be looked at as characters.
    return {reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), most)};
}

std::optional<double> numberIn(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    if (!(std::abs(value) <= kLargest)) return {};
    return value;
}

std::string quotedNumber(std::string_view text) {
    const std::string plain = plainNumber(text);
    return "\"" + printable(text) + "\"" + (plain.empty() ? "" : " (" + plain + " would be one)");
}

VendorLines::VendorLines(std::span<const std::byte> bytes,
                         const std::string& source,
                         bool (*joined)(std::string_view word))
    : source_(source), rest_(beginning(bytes, bytes.size())), joined_(joined) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

std::string_view VendorLines::takeLine() {
    ++linesTaken_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = trimmed(rest_.substr(0, end));
    const bool isPair = rest_.substr(end).starts_with("\r\n");
    rest_.remove_prefix(std::min(end + (isPair ? 2 : 1), rest_.size()));
    return line;
}

// A path of Windows in a comment may end with a backslash too, which joins nothing.
void VendorLines::joinLines() {
    if (joined_ == nullptr || !line_.ends_with('\\')) return;
    if (!joined_(line_.substr(0, line_.find_first_of(" \t")))) return;
    joinedLine_.clear();
    while (line_.ends_with('\\')) {
        joinedLine_.append(line_.substr(0, line_.size() - 1)) += ' ';
        line_ = rest_.empty() ? std::string_view() : takeLine();
    }
    joinedLine_.append(line_);
    line_ = trimmed(joinedLine_);
}

bool VendorLines::next() {
    line_ = {};
    while (line_.empty() && !rest_.empty()) {
        line_ = takeLine();
        lineNumber_ = linesTaken_;
        joinLines();
    }
    return !line_.empty();
}

std::vector<std::string_view> VendorLines::fields(char separator) const {
    std::vector<std::string_view> fields;
    for (std::string_view rest = line_; !rest.empty();) {
        const std::size_t end = separator == ' ' ? rest.find_first_of(" \t") : rest.find(separator);
        const std::string_view field = trimmed(rest.substr(0, end));
        if (separator != ' ' || !field.empty()) fields.push_back(field);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return fields;
}

double VendorLines::number(std::string_view field) const {
    const std::optional<double> value = numberIn(field);
    if (!value)
        fail("holds what is no number from -1e9 to 1e9, " + quotedNumber(field) +
             "; export the file anew");
    return *value;
}

std::uint32_t VendorLines::integer(std::string_view field, std::uint32_t most) const {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || value > most)
        fail("needs a whole number from 0 to " + std::to_string(most) + "; write the file anew");
    return value;
}

void VendorLines::fail(const std::string& why) const {
    throw Error(placed(why));
}

std::string VendorLines::placed(const std::string& what) const {
    return source_ + ":" + std::to_string(lineNumber_) + ": " + what;
}

void VendorBytes::go(std::size_t byte) {
    if (byte > bytes_.size()) fail("the file is cut off; copy it anew");
    at_ = byte;
}

std::uint8_t VendorBytes::u8() {
    if (left() < 1) fail("the file is cut off; copy it anew");
    return std::to_integer<std::uint8_t>(bytes_[at_++]);
}

std::uint16_t VendorBytes::u16() {
    const std::uint16_t low = u8();
    return static_cast<std::uint16_t>(low | u8() << 8);
}

std::uint32_t VendorBytes::u32() {
    const std::uint32_t low = u16();
    return low | static_cast<std::uint32_t>(u16()) << 16;
}

float VendorBytes::f32() {
    return std::bit_cast<float>(u32());
}

double VendorBytes::number() {
    const auto value = static_cast<double>(f32());
    if (!(std::abs(value) <= kLargest)) {
        at_ -= 4;
        fail("holds what is no number from -1e9 to 1e9; write the file anew");
    }
    return value;
}

void VendorBytes::need(std::uint64_t count, std::uint64_t bytesEach, const char* what) const {
    if (count > left() / bytesEach)
        fail("says that " + std::to_string(count) + " " + what +
             " follow, but the file ends before them; copy it anew");
}

void VendorBytes::fail(const std::string& why) const {
    throw Error(source_ + ": byte " + std::to_string(at_) + ": " + why);
}

}  // namespace aquarama::formats
