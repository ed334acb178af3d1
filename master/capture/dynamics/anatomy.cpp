// SPDX-License-Identifier: Apache-2.0
#include "master/capture/dynamics/anatomy.h"

#include <algorithm>
#include <cassert>

namespace aquarama::capture {

namespace {

constexpr int kRings = 5;
constexpr int kDorsalTip = 21;
constexpr int kVentralTip = 22;

// The k-th node of a ring: dorsal left, dorsal right, ventral right, ventral left, and round again.
constexpr int ringNode(int ring, int k) {
    return 1 + 4 * ring + k % 4;
}

constexpr Side sideOf(int k) {
    return k == 1 || k == 2 ? Side::Right : Side::Left;
}

class Builder {
  public:
    Anatomy build() {
        for (int k = 0; k < 4; ++k) {
            unit(0, ringNode(0, k), UnitKind::Normal);
            face(0, ringNode(0, k), ringNode(0, k + 1), 1);
        }
        for (int ring = 0; ring < kRings; ++ring) addRing(ring);
        for (int ring = 0; ring + 1 < kRings; ++ring) addSegment(ring);
        addTail();
        assert(units_ == kUnits && faces_ == kDragFaces);
        return anatomy_;
    }

  private:
    void addRing(int ring) {
        for (int k = 0; k < 4; ++k)
            unit(ringNode(ring, k), ringNode(ring, k + 1), UnitKind::Normal);
        unit(ringNode(ring, 0), ringNode(ring, 2), UnitKind::Cross);
        unit(ringNode(ring, 1), ringNode(ring, 3), UnitKind::Cross);
    }

    // Between a ring and the next: four units along the body and two struts across each face.
    void addSegment(int ring) {
        constexpr std::array<UnitKind, 4> kAlong{
            UnitKind::FrontMuscle, UnitKind::MiddleMuscle, UnitKind::BackMuscle, UnitKind::Normal};
        const UnitKind along = kAlong.at(static_cast<std::size_t>(ring));
        for (int k = 0; k < 4; ++k) {
            const Side side = along == UnitKind::Normal ? Side::Neither : sideOf(k);
            unit(ringNode(ring, k), ringNode(ring + 1, k), along, side);
            unit(ringNode(ring, k), ringNode(ring + 1, k + 1), UnitKind::Cross);
            unit(ringNode(ring, k + 1), ringNode(ring + 1, k), UnitKind::Cross);
            quad(ringNode(ring, k),
                 ringNode(ring + 1, k),
                 ringNode(ring + 1, k + 1),
                 ringNode(ring, k + 1));
        }
    }

    void addTail() {
        const int dorsalLeft = ringNode(4, 0);
        const int dorsalRight = ringNode(4, 1);
        const int ventralRight = ringNode(4, 2);
        const int ventralLeft = ringNode(4, 3);
        for (const int node : {dorsalLeft, dorsalRight}) {
            unit(node, kDorsalTip, UnitKind::Normal);
            unit(node, kVentralTip, UnitKind::Cross);
        }
        for (const int node : {ventralRight, ventralLeft}) {
            unit(node, kVentralTip, UnitKind::Normal);
            unit(node, kDorsalTip, UnitKind::Cross);
        }
        unit(kDorsalTip, kVentralTip, UnitKind::Normal);
        face(dorsalLeft, kDorsalTip, dorsalRight, 1);
        face(ventralRight, kVentralTip, ventralLeft, 1);
        quad(dorsalRight, kDorsalTip, kVentralTip, ventralRight);
        quad(ventralLeft, kVentralTip, kDorsalTip, dorsalLeft);
    }

    void unit(int a, int b, UnitKind kind, Side side = Side::Neither) {
        anatomy_.units.at(units_++) = {static_cast<std::uint8_t>(std::min(a, b)),
                                       static_cast<std::uint8_t>(std::max(a, b)),
                                       kind,
                                       side};
    }
    void face(int a, int b, int c, double weight) {
        anatomy_.faces.at(faces_++) = {{static_cast<std::uint8_t>(a),
                                        static_cast<std::uint8_t>(b),
                                        static_cast<std::uint8_t>(c)},
                                       weight};
    }
    void quad(int a, int b, int c, int d) {
        face(a, b, c, 0.5);
        face(a, c, d, 0.5);
        face(a, b, d, 0.5);
        face(b, c, d, 0.5);
    }

    Anatomy anatomy_;
    std::size_t units_ = 0;
    std::size_t faces_ = 0;
};

// The same ring, its nodes exchanged in the given way.
int exchanged(int node, const std::array<int, 4>& exchange) {
    const int ring = (node - 1) / 4;
    return ringNode(ring, exchange.at(static_cast<std::size_t>((node - 1) % 4)));
}

}  // namespace

const Anatomy& anatomy() {
    static const Anatomy kAnatomy = Builder().build();
    return kAnatomy;
}

int mirroredLeftRight(int node) {
    const bool isOnMidplane = node == 0 || node >= kDorsalTip;
    return isOnMidplane ? node : exchanged(node, {1, 0, 3, 2});
}

int mirroredTopBottom(int node) {
    if (node == 0) return 0;
    if (node >= kDorsalTip) return kDorsalTip + kVentralTip - node;
    return exchanged(node, {3, 2, 1, 0});
}

}  // namespace aquarama::capture
