// SPDX-License-Identifier: Apache-2.0
#include "calibration/drift/drift.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "common/base/log.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::drift {

namespace {

// A channel with fewer dots is not judged: the fit of its slopes has six terms for each axis.
constexpr std::size_t kLeastDots = 8;

// A dot of the reference and where it is now; camera pixels.
struct DotPair {
    std::size_t channel = 0;
    glm::dvec2 pixel{};  // of the channel, from its middle, as a share of half its width
    glm::dvec2 before{}, after{};
    glm::dmat2 channelFromCamera{1.0};
};

// Both axes are divided by half the width, so that a unit is as long across as down.
glm::dvec2 fromMiddle(int dot, glm::ivec2 size) {
    return (wall::scanDotPlace(dot, size) - glm::dvec2(size) / 2.0) / (size.x / 2.0);
}

// Of a surface of third degree and its slopes, across and down; the first six terms are of second
// degree.
constexpr std::size_t kCubicTerms = 10;
constexpr std::size_t kQuadraticTerms = 6;
std::array<std::array<double, kCubicTerms>, 3> termsAt(glm::dvec2 p) {
    const double x = p.x, y = p.y;
    return {{{1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y},
             {0, 1, 0, 2 * x, y, 0, 3 * x * x, 2 * x * y, y * y, 0},
             {0, 0, 1, 0, x, 2 * y, 0, x * x, 2 * x * y, 3 * y * y}}};
}

// From pixels of the camera to those of the channel, near each of its dots.
void findSlopes(std::span<DotPair> pairs, double halfWidth) {
    constexpr std::size_t kEnoughDots = 16;
    const std::size_t count = pairs.size() < kEnoughDots ? kQuadraticTerms : kCubicTerms;
    Eigen::MatrixXd rows(pairs.size(), count), places(pairs.size(), 2);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto terms = termsAt(pairs[i].pixel)[0];
        for (std::size_t k = 0; k < count; ++k)
            rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = terms[k];
        places.row(static_cast<Eigen::Index>(i)) << pairs[i].before.x, pairs[i].before.y;
    }
    const Eigen::MatrixXd found = rows.colPivHouseholderQr().solve(places);
    for (DotPair& pair : pairs) {
        const auto terms = termsAt(pair.pixel);
        const auto slope = [&](std::size_t way) {
            const Eigen::Map<const Eigen::RowVectorXd> row(terms[way].data(),
                                                           static_cast<Eigen::Index>(count));
            const Eigen::RowVector2d sum = row * found;
            return glm::dvec2(sum.x(), sum.y());
        };
        pair.channelFromCamera = halfWidth * glm::inverse(glm::dmat2(slope(1), slope(2)));
    }
}

// A small movement of a camera in its picture: across, down, about its axis, and nearer. `bend` is
// the square of the picture's width over the focal length: how much more its sides move.
struct CameraMove {
    Eigen::Vector4d by = Eigen::Vector4d::Zero();
    double bend = 0;
};

using MoveTerms = Eigen::Matrix<double, 2, 4>;

MoveTerms moveTerms(glm::dvec2 place, glm::dvec2 size, double bend) {
    const glm::dvec2 p = (place - size / 2.0) / size.x;
    MoveTerms terms;
    terms << 1 + bend * p.x * p.x, bend * p.x * p.y, -p.y, p.x, bend * p.x * p.y,
        1 + bend * p.y * p.y, p.x, p.y;
    return terms;
}

glm::dvec2 movedBy(const CameraMove& move, glm::dvec2 place, glm::dvec2 size) {
    const Eigen::Vector2d by = moveTerms(place, size, move.bend) * move.by;
    return {by.x(), by.y()};
}

// The movement of a dot that is due to its projector, in pixels of its channel.
glm::dvec2 ownWay(const DotPair& pair, const CameraMove& move, glm::dvec2 size) {
    return pair.channelFromCamera * (pair.after - pair.before - movedBy(move, pair.before, size));
}

// Finds the movement of the camera on which most dots agree. A projector that has moved takes its
// dots with it. The dots of the others still agree with a movement of the camera, which has five
// parameters for all of them.
class CameraMoveSearch {
  public:
    CameraMoveSearch(const std::vector<DotPair>& pairs, glm::dvec2 size)
        : pairs_{pairs}, size_{size} {}

    // The best of the candidates: no movement, and fits to the dots of one, of two and of all
    // channels.
    [[nodiscard]] CameraMove find(std::size_t channels) {
        if (channels < 2) return {};
        std::vector<double> all(pairs_.size(), 1);
        consider(all);
        for (std::size_t a = 0; a < channels; ++a)
            for (std::size_t b = a; b < channels; ++b) {
                std::vector<double> some;
                for (const DotPair& pair : pairs_)
                    some.push_back(pair.channel == a || pair.channel == b ? 1 : 0);
                consider(some);
            }
        const CameraMove better = refined(move_);
        return costOf(better) < cost_ ? better : move_;
    }

  private:
    // The movement must explain the dots clearly better than a camera that stands still.
    void consider(const std::vector<double>& weights) {
        for (const double bend : {0.0, 0.3, 0.6, 1.0, 1.5, 2.2, 3.0, 4.5, 6.5, 9.0}) {
            const CameraMove move = fitted(weights, bend);
            const double cost = costOf(move);
            if (cost > 0.85 * stillCost_ || cost >= cost_) continue;
            cost_ = cost;
            move_ = move;
        }
    }
    // Weighted least squares for four unknowns at a fixed bend. The small diagonal keeps the system
    // solvable where all weights are 0.
    [[nodiscard]] CameraMove fitted(const std::vector<double>& weights, double bend) const {
        Eigen::Matrix4d square = 1e-9 * Eigen::Matrix4d::Identity();
        Eigen::Vector4d right = Eigen::Vector4d::Zero();
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const MoveTerms terms = moveTerms(pairs_[i].before, size_, bend);
            const glm::dvec2 way = pairs_[i].after - pairs_[i].before;
            square += weights[i] * terms.transpose() * terms;
            right += weights[i] * terms.transpose() * Eigen::Vector2d(way.x, way.y);
        }
        return {square.ldlt().solve(right), bend};
    }
    // A measure that is small where many dots agree well, even if others disagree.
    [[nodiscard]] double costOf(const CameraMove& move) const {
        double cost = 0;
        for (const DotPair& pair : pairs_)
            cost += std::log1p(std::pow(glm::length(ownWay(pair, move, size_)) / kNoise, 2));
        return cost;
    }
    // Reweighted in each step: a dot that disagrees counts less in the next one. The bend stays.
    [[nodiscard]] CameraMove refined(CameraMove move) const {
        constexpr int kSteps = 40;
        for (int step = 0; step < kSteps; ++step) {
            std::vector<double> weights;
            for (const DotPair& pair : pairs_) {
                const double way = glm::length(ownWay(pair, move, size_));
                weights.push_back(1 / (way * way + kNoise * kNoise));
            }
            move = fitted(weights, move.bend);
        }
        return move;
    }

    static constexpr double kNoise = 0.02;  // of dots, pixels of their channels
    const std::vector<DotPair>& pairs_;
    glm::dvec2 size_;
    double stillCost_ = costOf({}), cost_ = stillCost_;
    CameraMove move_;
};

// The movements of a channel's dots as one linear movement: its mean and its slopes to the right
// and down, in both axes. It minimises the sum of distances, not of squares, so that outliers
// hardly count.
Eigen::Matrix<double, 3, 2> smoothWay(std::span<const DotPair> pairs,
                                      const CameraMove& move,
                                      glm::dvec2 size) {
    constexpr int kSteps = 20;
    constexpr double kNoise = 0.03;  // pixels
    Eigen::Matrix<double, 3, 2> way = Eigen::Matrix<double, 3, 2>::Zero();
    std::vector<double> weights(pairs.size(), 1);
    for (int step = 0; step < kSteps; ++step) {
        Eigen::Matrix3d square = 1e-9 * Eigen::Matrix3d::Identity();
        Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const Eigen::Vector3d terms(1, pairs[i].pixel.x, pairs[i].pixel.y);
            const glm::dvec2 own = ownWay(pairs[i], move, size);
            square += weights[i] * terms * terms.transpose();
            right += weights[i] * terms * Eigen::RowVector2d(own.x, own.y);
        }
        way = square.ldlt().solve(right);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const glm::dvec2 own = ownWay(pairs[i], move, size);
            const Eigen::RowVector3d terms(1, pairs[i].pixel.x, pairs[i].pixel.y);
            weights[i] =
                1 / std::max((terms * way - Eigen::RowVector2d(own.x, own.y)).norm(), kNoise);
        }
    }
    return way;
}

// `turn` is the antisymmetric part of the linear movement, `zoom` half its trace; pixels at the
// sides of the picture.
ChannelDrift driftOfChannel(std::span<const DotPair> pairs,
                            const CameraMove& move,
                            glm::dvec2 size,
                            glm::ivec2 channelPixels) {
    ChannelDrift drift{.dots = pairs.size()};
    if (pairs.size() < kLeastDots) return drift;
    const auto way = smoothWay(pairs, move, size);
    double squares = 0;
    for (int dot = 0; dot < wall::kScanDotCount; ++dot) {
        const glm::dvec2 pixel = fromMiddle(dot, channelPixels);
        squares += (Eigen::RowVector3d(1, pixel.x, pixel.y) * way).squaredNorm();
    }
    drift.shift = std::sqrt(squares / wall::kScanDotCount);
    drift.right = way(0, 0);
    drift.down = way(0, 1);
    drift.turn = (way(1, 1) - way(2, 0)) / 2;
    drift.zoom = (way(1, 0) + way(2, 1)) / 2;
    drift.verdict = drift.shift > kMostDriftPixels ? DriftVerdict::Moved : DriftVerdict::InPlace;
    return drift;
}

// Null where the dot is not among them. The pointer is valid as long as `dots` is unchanged.
const SeenDot* found(const std::vector<SeenDot>& dots, const SeenDot& wanted) {
    const auto at = std::ranges::find_if(dots, [&](const SeenDot& dot) {
        return dot.channel == wanted.channel && dot.dot == wanted.dot;
    });
    return at == dots.end() ? nullptr : &*at;
}

// The drift of a channel; slopes come from all dots that the reference has of it.
std::vector<DotPair> pairsOf(const Reference& reference,
                             const std::vector<SeenDot>& now,
                             std::size_t channel,
                             glm::ivec2 size) {
    std::vector<DotPair> all, pairs;
    std::vector<const SeenDot*> again;
    for (const SeenDot& dot : reference.dots) {
        if (dot.channel != channel) continue;
        all.push_back({channel, fromMiddle(dot.dot, size), dot.place, dot.place});
        again.push_back(found(now, dot));
    }
    if (all.size() < kLeastDots) return {};
    findSlopes(all, size.x / 2.0);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (again[i] == nullptr) continue;
        pairs.push_back(all[i]);
        pairs.back().after = again[i]->place;
    }
    return pairs;
}

}  // namespace

// The camera's movement is found first, from the dots of all channels. A channel is judged by the
// rest.
WallDrift driftOf(const Reference& reference,
                  const std::vector<SeenDot>& now,
                  const config::Rig& rig) {
    const glm::dvec2 size(reference.cameraPixels);
    std::vector<DotPair> pairs;
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        const auto more = pairsOf(reference, now, i, rig.channels[i].sizePixels);
        pairs.insert(pairs.end(), more.begin(), more.end());
        ends.push_back(pairs.size());
    }
    const CameraMove move = CameraMoveSearch(pairs, size).find(rig.channels.size());
    WallDrift drift;
    for (const DotPair& pair : pairs)
        drift.cameraPixels +=
            glm::length(movedBy(move, pair.before, size)) / static_cast<double>(pairs.size());
    constexpr double kMostCameraShare = 0.01;  // of its picture's width
    drift.isCameraLost = drift.cameraPixels > kMostCameraShare * size.x;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < ends.size(); begin = ends[i++])
        drift.channels.push_back(driftOfChannel(std::span(pairs).subspan(begin, ends[i] - begin),
                                                move,
                                                size,
                                                rig.channels[i].sizePixels));
    return drift;
}

namespace {

// As jsonOf() writes it.
const char* nameOf(DriftVerdict verdict) {
    return verdict == DriftVerdict::InPlace ? "in place"
           : verdict == DriftVerdict::Moved ? "moved"
                                            : "not seen";
}

// Reads [channel, dot, x, y, radius]. Throws Error where the channel is not the rig's or a number
// is out of its range.
SeenDot dotFrom(const nlohmann::json& in, const config::Rig& rig, glm::ivec2 cameraPixels) {
    const auto channel =
        std::ranges::find(rig.channels, in.at(0).get<std::string>(), &config::Channel::name);
    SeenDot dot{.channel = static_cast<std::size_t>(channel - rig.channels.begin()),
                .dot = in.at(1).get<int>(),
                .place = {in.at(2).get<double>(), in.at(3).get<double>()},
                .radius = in.at(4).get<double>()};
    const bool isInside = dot.place.x >= 0 && dot.place.y >= 0 && dot.place.x <= cameraPixels.x &&
                          dot.place.y <= cameraPixels.y && dot.radius > 0 &&
                          dot.radius < cameraPixels.x;
    if (channel == rig.channels.end() || dot.dot < 0 || dot.dot >= wall::kScanDotCount || !isInside)
        throw Error("a dot is none of this rig's");
    return dot;
}

}  // namespace

// Channels are written by their names: their order in the rig may change.
std::string textOf(const Reference& reference, const config::Rig& rig) {
    nlohmann::ordered_json dots = nlohmann::ordered_json::array();
    for (const SeenDot& dot : reference.dots)
        dots.push_back(
            {rig.channels[dot.channel].name, dot.dot, dot.place.x, dot.place.y, dot.radius});
    return nlohmann::ordered_json{{"rig", rig.name},
                                  {"learned", reference.learned},
                                  {"camera_width_px", reference.cameraPixels.x},
                                  {"camera_height_px", reference.cameraPixels.y},
                                  {"dots", dots}}
               .dump() +
           "\n";
}

// Every exception, that of the JSON library too, becomes an Error that says what to do.
Reference parseReference(const std::string& text,
                         const std::string& source,
                         const config::Rig& rig) {
    constexpr int kMostPixels = 65536;
    try {
        const auto in = nlohmann::json::parse(text);
        Reference reference{.learned = in.at("learned").get<std::string>(),
                            .cameraPixels = {in.at("camera_width_px").get<int>(),
                                             in.at("camera_height_px").get<int>()},
                            .dots = {}};
        if (std::clamp(reference.cameraPixels.x, 1, kMostPixels) != reference.cameraPixels.x ||
            std::clamp(reference.cameraPixels.y, 1, kMostPixels) != reference.cameraPixels.y)
            throw Error("its camera has no size");
        for (const auto& dot : in.at("dots"))
            reference.dots.push_back(dotFrom(dot, rig, reference.cameraPixels));
        return reference;
    } catch (const std::exception& problem) {
        throw Error(source + ": is no reference of this rig (" + problem.what() +
                    "); make one by aquarama drift --learn");
    }
}

// Pixels of the channel's own picture, with what to do where it is not in place.
std::string lineOf(const config::Channel& channel, const ChannelDrift& drift) {
    if (drift.verdict == DriftVerdict::NotSeen)
        return fmt::format(
            "{}: only {} dots are found where they were: see what hides them, or "
            "calibrate again",
            channel.name,
            drift.dots);
    if (drift.verdict == DriftVerdict::InPlace)
        return fmt::format("{}: {:.2f} px, in place", channel.name, drift.shift);
    return fmt::format(
        "{}: moved by {:.2f} px ({:.2f} right, {:.2f} down, {:.2f} turned, {:.2f} "
        "larger): calibrate again",
        channel.name,
        drift.shift,
        drift.right,
        drift.down,
        drift.turn,
        drift.zoom);
}

// Channels are in the order of the rig's; `verdict` is in the words of nameOf().
std::string jsonOf(const WallDrift& drift,
                   const std::string& looked,
                   const Reference& reference,
                   const config::Rig& rig) {
    nlohmann::ordered_json channels = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < drift.channels.size(); ++i) {
        const ChannelDrift& one = drift.channels[i];
        channels.push_back({{"name", rig.channels[i].name},
                            {"verdict", nameOf(one.verdict)},
                            {"shift_px", one.shift},
                            {"right_px", one.right},
                            {"down_px", one.down},
                            {"turn_px", one.turn},
                            {"zoom_px", one.zoom},
                            {"dots", one.dots}});
    }
    return nlohmann::ordered_json{{"looked", looked},
                                  {"learned", reference.learned},
                                  {"camera_moved_px", drift.cameraPixels},
                                  {"camera_lost", drift.isCameraLost},
                                  {"channels", channels}}
               .dump(2) +
           "\n";
}

}  // namespace aquarama::drift
