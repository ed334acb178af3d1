// SPDX-License-Identifier: Apache-2.0
// Reads Wavefront obj: v, vt and f. Names, normals and materials are skipped; free-form surfaces
// too, with a remark.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <unordered_map>

#include <glm/geometric.hpp>

#include "common/base/log.h"
#include "common/formats/archive.h"
#include "common/formats/vendors.h"

namespace aquarama::formats {

namespace {

constexpr std::size_t kTellingObj = 4096;
constexpr std::size_t kMostTriangles = 2 * kMostVertices;
constexpr std::size_t kMostWord = 32;  // characters of a word in a remark
constexpr std::array<std::string_view, 13> kKeywords{
    "v", "vt", "vn", "vp", "f", "o", "g", "s", "l", "p", "mtllib", "usemtl", "mg"};

// Of those, the ones whose lines may go on in the next.
bool isElement(std::string_view word) {
    return word == "f" || word == "l" || word == "p" || (word.starts_with('v') && word.size() < 3);
}

// A corner of a face: a point and, unless it is kNone, a texture coordinate.
struct ObjCorner {
    std::uint32_t point = 0, texture = 0;
};
constexpr std::uint32_t kNone = 0xffffffffU;

struct ObjReader {
    VendorLines lines;
    std::vector<std::string> remarks;
    std::vector<glm::dvec3> points;
    std::vector<glm::dvec2> textures;
    // Which point of the mesh a corner is.
    std::unordered_map<std::uint64_t, std::uint32_t> known;
    std::vector<ObjCorner> corners;  // of the mesh's points
    TriangleMesh mesh;
    std::set<std::string> said;  // unknown words that have a remark

    // Weights and colours after the three numbers are ignored.
    void readPoint(const std::vector<std::string_view>& fields) {
        if (fields.size() < 4 || points.size() == kMostVertices)
            lines.fail("a point needs x y z, and at most 4194304 points may be; export it anew");
        points.emplace_back(
            lines.number(fields[1]), lines.number(fields[2]), lines.number(fields[3]));
    }

    // Up to two numbers are used; a depth is ignored.
    void readTexture(const std::vector<std::string_view>& fields) {
        if (fields.size() < 3 || textures.size() == kMostVertices)
            lines.fail("a vt needs u v, and at most 4194304 may be; export it anew");
        textures.emplace_back(lines.number(fields[1]), lines.number(fields[2]));
    }

    // From 1, or negative from the last one.
    [[nodiscard]] std::uint32_t index(std::string_view text, std::size_t count) const {
        const double value = numberIn(text).value_or(0);
        const auto most = static_cast<double>(count);
        const double from0 = value > 0 ? value - 1 : most + value;
        if (value == 0 || value != std::floor(value) || from0 < 0 || from0 >= most)
            lines.fail("a face names what no line above defines; export it anew");
        return static_cast<std::uint32_t>(from0);
    }

    [[nodiscard]] ObjCorner corner(std::string_view field) const {
        const std::size_t slash = std::min(field.find('/'), field.size());
        ObjCorner corner{index(field.substr(0, slash), points.size()), kNone};
        std::string_view rest = field.substr(std::min(slash + 1, field.size()));
        rest = rest.substr(0, rest.find('/'));
        if (!rest.empty()) corner.texture = index(rest, textures.size());
        return corner;
    }

    // The point of the mesh at a corner; added where it is new.
    std::uint32_t pointOf(ObjCorner corner) {
        const std::uint64_t key = std::uint64_t{corner.point} << 32 | corner.texture;
        const auto [found, added] =
            known.try_emplace(key, static_cast<std::uint32_t>(mesh.points.size()));
        if (!added) return found->second;
        const bool textured = corner.texture != kNone;
        if (mesh.points.size() == kMostVertices)
            lines.fail("the mesh has more than 4194304 points; export a coarser one");
        if (!corners.empty() && textured != (corners.front().texture != kNone))
            lines.fail("has vt where other faces have none, or the other way; export it anew");
        corners.push_back(corner);
        mesh.points.push_back(points[corner.point]);
        if (textured) mesh.textures.push_back(textures[corner.texture]);
        return found->second;
    }

    // A triangle whose points are one by their places is no part of the surface.
    void addTriangle(const std::array<std::uint32_t, 3>& t) {
        for (std::size_t i = 0; i < 3; ++i)
            if (corners[t[i]].point == corners[t[(i + 1) % 3]].point)
                lines.fail("a face has one point twice; export it anew");
        const auto side = [&](std::size_t to) { return mesh.points[t[to]] - mesh.points[t[0]]; };
        if (glm::cross(side(1), side(2)) == glm::dvec3(0)) return;
        if (mesh.triangles.size() == kMostTriangles)
            lines.fail("the mesh has more than 8388608 triangles; export a coarser one");
        mesh.triangles.push_back(t);
    }

    // A fan about its first corner.
    void readFace(const std::vector<std::string_view>& fields) {
        if (fields.size() < 4) lines.fail("a face has fewer than three corners; export it anew");
        std::array<std::uint32_t, 3> fan{pointOf(corner(fields[1])), pointOf(corner(fields[2])), 0};
        for (std::size_t i = 3; i < fields.size(); ++i) {
            fan[2] = pointOf(corner(fields[i]));
            addTriangle(fan);
            fan[1] = fan[2];
        }
    }

    // Up to the comment after them.
    [[nodiscard]] std::vector<std::string_view> fields() const {
        auto fields = lines.fields(' ');
        const auto comment = std::ranges::find_if(
            fields, [](std::string_view field) { return field.starts_with('#'); });
        fields.erase(comment, fields.end());
        return fields;
    }

    void readLine() {
        const auto parts = fields();
        if (parts.empty()) return;
        if (parts[0] == "v") readPoint(parts);
        if (parts[0] == "vt") readTexture(parts);
        if (parts[0] == "f") readFace(parts);
        if (std::ranges::find(kKeywords, parts[0]) == kKeywords.end()) sayPassedOver(parts[0]);
    }

    // Free-form curves and surfaces, as a rule.
    void sayPassedOver(std::string_view word) {
        if (said.size() == kMostRemarks ||
            !said.insert(std::string(word.substr(0, kMostWord))).second)
            return;
        remark(remarks,
               lines.placed("\"" + printable(word) +
                            "\" is passed over: export the surface as triangles"));
    }
};

}  // namespace

bool isObj(std::span<const std::byte> bytes) {
    const std::string source;
    VendorLines lines(bytes.first(std::min(bytes.size(), kTellingObj)), source);
    while (lines.next()) {
        if (lines.line().starts_with('#')) continue;
        const auto fields = lines.fields(' ');
        return fields.size() > 1 && std::ranges::find(kKeywords, fields[0]) != kKeywords.end();
    }
    return false;
}

TriangleMesh readObj(std::span<const std::byte> bytes, const std::string& source) {
    ObjReader reader{VendorLines(bytes, source, isElement), {}, {}, {}, {}, {}, {}, {}};
    while (reader.lines.next()) reader.readLine();
    if (reader.mesh.triangles.empty()) reader.lines.fail("the mesh has no face; export it anew");
    reader.mesh.remarks = std::move(reader.remarks);
    return std::move(reader.mesh);
}

WallFile readObjWarp(std::span<const std::byte> bytes,
                     const std::string& source,
                     const ReadOptions& options) {
    TriangleMesh surface = readObj(bytes, source);
    if (surface.textures.empty())
        throw Error(source +
                    ": has no texture coordinates (vt), which would say where in the projector's "
                    "picture its points are; export them");
    WarpMesh mesh;
    for (std::size_t i = 0; i < surface.points.size(); ++i)
        mesh.vertices.push_back(
            {{surface.textures[i].x, 1 - surface.textures[i].y}, surface.points[i]});
    mesh.triangles = std::move(surface.triangles);
    FileChannel channel;
    channel.name = stemOf(source);
    addMesh(channel, std::move(mesh), source, options);
    WallFile wall = oneChannel(Profile::Screen, std::move(channel));
    wall.remarks = std::move(surface.remarks);
    return wall;
}

}  // namespace aquarama::formats
