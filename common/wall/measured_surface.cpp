// SPDX-License-Identifier: Apache-2.0
// The surface of a measured screen: triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/log.h"
#include "common/formats/vendors.h"
#include "common/wall/surface.h"

namespace aquarama::wall {

namespace {

struct Triangle {
    glm::dvec3 corner, first, second;  // two edges from the corner
    [[nodiscard]] glm::dvec3 normal() const { return glm::cross(first, second); }
};

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(glm::dvec3 point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    void add(const Triangle& triangle) {
        for (const glm::dvec3 edge : {glm::dvec3(0), triangle.first, triangle.second})
            add(triangle.corner + edge);
    }
    // Whether the ray passes it nearer than `most`, in lengths of the direction.
    [[nodiscard]] bool meets(glm::dvec3 origin, glm::dvec3 inverse, double most) const {
        const glm::dvec3 a = (low - origin) * inverse;
        const glm::dvec3 b = (high - origin) * inverse;
        const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
        const double in = std::max({near.x, near.y, near.z, 0.0});
        return in <= std::min({far.x, far.y, far.z, most});
    }
};

struct Crossing {
    double along = std::numeric_limits<double>::infinity();
    const Triangle* triangle = nullptr;
};

// Moeller and Trumbore 1997; both sides count.
double distanceTo(const Triangle& triangle, const Ray& ray) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const glm::dvec3 p = glm::cross(ray.direction, triangle.second);
    const double determinant = glm::dot(triangle.first, p);
    if (determinant == 0) return kNever;
    const glm::dvec3 from = (ray.origin - triangle.corner) / determinant;
    const double u = glm::dot(from, p);
    const glm::dvec3 q = glm::cross(from, triangle.first);
    const double v = glm::dot(ray.direction, q);
    constexpr double kSlack = 1e-9;  // no ray slips through between two triangles
    if (u < -kSlack || v < -kSlack || u + v > 1 + kSlack) return kNever;
    const double along = glm::dot(triangle.second, q);
    return along > 0 ? along : kNever;
}

// A tree of boxes over triangles: node i has its children at `child` and child + 1.
class BoxTree {
  public:
    explicit BoxTree(std::vector<Triangle> triangles) : triangles_{std::move(triangles)} {
        nodes_.push_back({.first = 0, .count = triangles_.size()});
        for (std::size_t i = 0; i < nodes_.size(); ++i) split(i);
    }

    [[nodiscard]] Crossing nearest(const Ray& ray) const {
        glm::dvec3 inverse;  // finite for zeros too: infinity times zero is no number
        for (int i = 0; i < 3; ++i)
            inverse[i] = 1 / (ray.direction[i] != 0 ? ray.direction[i] : 1e-300);
        Crossing best;
        std::array<std::size_t, kDeepest> open{0};
        std::size_t count = 1;
        while (count > 0) {
            const Node& node = nodes_[open[--count]];
            if (!node.box.meets(ray.origin, inverse, best.along)) continue;
            if (node.child != 0) {
                open[count++] = node.child;
                open[count++] = node.child + 1;
                continue;
            }
            for (std::size_t i = node.first; i < node.first + node.count; ++i) {
                const double along = distanceTo(triangles_[i], ray);
                if (along < best.along) best = {along, &triangles_[i]};
            }
        }
        return best;
    }

  private:
    struct Node {
        Box box{};
        std::size_t first = 0, count = 0;
        std::size_t child = 0;  // 0: a leaf
    };
    static constexpr std::size_t kDeepest = 64;  // halves: more than any memory holds
    static constexpr std::size_t kLeaf = 4;

    // Halves a node's triangles by the middle of the longest side of its box.
    void split(std::size_t index) {
        Node node = nodes_[index];
        const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(node.first);
        const auto end = begin + static_cast<std::ptrdiff_t>(node.count);
        for (auto triangle = begin; triangle != end; ++triangle) node.box.add(*triangle);
        if (node.count > kLeaf) {
            const glm::dvec3 size = node.box.high - node.box.low;
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            const auto middle = begin + static_cast<std::ptrdiff_t>(node.count / 2);
            std::nth_element(begin, middle, end, [axis](const Triangle& a, const Triangle& b) {
                return (a.corner + (a.first + a.second) / 3.0)[axis] <
                       (b.corner + (b.first + b.second) / 3.0)[axis];
            });
            node.child = nodes_.size();
            const std::size_t half = node.count / 2;
            nodes_.push_back({.first = node.first, .count = half});
            nodes_.push_back({.first = node.first + half, .count = node.count - half});
        }
        nodes_[index] = node;
    }

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

// The edges that belong to one triangle only.
std::vector<std::pair<std::uint32_t, std::uint32_t>> borderOf(const formats::TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
            ++uses[{low, high}];
        }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& [edge, count] : uses)
        if (count == 1) edges.push_back(edge);
    return edges;
}

class Measured final : public ScreenSurface {
  public:
    Measured(const formats::TriangleMesh& mesh, glm::dvec3 sweetSpot)
        : view_{sweetSpot}, tree_{trianglesOf(mesh)} {
        constexpr int kStepsPerEdge = 16;
        for (const auto& [from, to] : borderOf(mesh))
            for (int i = 0; i < kStepsPerEdge; ++i)
                border_.push_back(glm::mix(
                    mesh.points[from], mesh.points[to], static_cast<double>(i) / kStepsPerEdge));
        view_.enclose(mesh.points);
    }

    [[nodiscard]] std::optional<glm::dvec3> hit(const Ray& ray, double) const override {
        const Crossing crossing = tree_.nearest(ray);
        if (crossing.triangle == nullptr) return std::nullopt;
        const glm::dvec3 point = ray.origin + crossing.along * ray.direction;
        const bool isOurSide = glm::dot(facing(*crossing.triangle), ray.direction) < 0;
        return isOurSide ? std::optional(point) : std::nullopt;
    }
    // Of the triangle that is seen there from the sweet spot.
    [[nodiscard]] glm::dvec3 normalAt(glm::dvec3 point) const override {
        const Crossing crossing = tree_.nearest({view_.eye(), point - view_.eye()});
        return crossing.triangle != nullptr ? facing(*crossing.triangle) : view_.eye() - point;
    }
    [[nodiscard]] glm::dvec2 unrolled(glm::dvec3 point) const override {
        return view_.placeOf(point);
    }
    [[nodiscard]] std::optional<glm::dvec3> at(glm::dvec2 position) const override {
        return hit({view_.eye(), view_.directionAt(position)}, 0);
    }
    [[nodiscard]] std::vector<glm::dvec3> border(double) const override { return border_; }
    [[nodiscard]] PatternGround patternGround() const override {
        return {.kind = PatternGround::Kind::Far};
    }

  private:
    static std::vector<Triangle> trianglesOf(const formats::TriangleMesh& mesh) {
        std::vector<Triangle> triangles;
        for (const auto& [a, b, c] : mesh.triangles)
            triangles.push_back(
                {mesh.points[a], mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]});
        return triangles;
    }
    // The normal on the side of the sweet spot.
    [[nodiscard]] glm::dvec3 facing(const Triangle& triangle) const {
        const glm::dvec3 normal = triangle.normal();
        return glm::dot(normal, view_.eye() - triangle.corner) < 0 ? -normal : normal;
    }

    ViewBox view_;
    BoxTree tree_;
    std::vector<glm::dvec3> border_;
};

}  // namespace

std::unique_ptr<const ScreenSurface> makeMeasuredSurface(const config::Rig& rig) {
    const std::string& file = rig.screen.meshFile;
    const auto content = rig.files.find(file);
    if (content == rig.files.end()) throw Error(file + ": the measured screen is missing");
    const formats::TriangleMesh mesh = formats::readObj(*content->second, file);
    formats::sayRemarks(mesh.remarks);
    if (mesh.triangles.empty())
        throw Error(file + ": has no faces; export the screen as triangles or polygons");
    return std::make_unique<Measured>(mesh, rig.sweetSpotMetres);
}

}  // namespace aquarama::wall
