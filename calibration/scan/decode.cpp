// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/decode.h"

#include <algorithm>
#include <bit>
#include <set>
#include <thread>
#include <tuple>

#include "calibration/scan/axis_reader.h"
#include "calibration/scan/faults.h"
#include "calibration/scan/frames.h"
#include "calibration/scan/neighbours.h"
#include "calibration/scan/stripe_shift.h"
#include "common/base/log.h"
#include "common/base/statistics.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

using config::ScanPattern;
using Kind = ScanPattern::Kind;
using Indices = std::vector<std::size_t>;

// A channel lights a pixel that has this share of the light of its brightest pixels, and at least
// kLeastLight.
constexpr float kLitShare = 0.05F, kLeastLight = 0.004F;
// Two channels of a round light a pixel where the fainter gives this share of the brighter.
constexpr float kShared = 0.6F;

Indices channelsIn(std::uint64_t set) {
    Indices channels;
    for (; set != 0; set &= set - 1)
        channels.push_back(static_cast<std::size_t>(std::countr_zero(set)));
    return channels;
}

// The axis that a pattern measures: 0 columns, 1 rows, -1 none.
int axisOf(Kind kind) {
    if (!isGray(kind) && !isPhase(kind)) return -1;
    return isOfRows(kind) ? 1 : 0;
}

bool isWhiteOf(const ScanPattern& pattern, std::size_t channel) {
    return pattern.kind == Kind::Level && pattern.lit == config::bitOf(channel) &&
           pattern.light == glm::vec3(1);
}

// The columns of a sampled picture, about.
constexpr int kSampleColumns = 640;

// The sum of the linear light of the 3 x 3 pixels around one; NaN where one is clipped.
glm::vec3 sumAround(const Picture& picture, std::size_t pixel, const std::vector<float>& table) {
    const auto width = static_cast<std::size_t>(picture.sizePixels.x);
    const auto full = static_cast<std::uint16_t>(0.995F * static_cast<float>(table.size() - 1));
    glm::vec3 sum(0);
    for (const std::size_t row : {pixel - width, pixel, pixel + width}) {
        const std::uint16_t* code = &picture.rgb[3 * (row - 1)];
        for (int i = 0; i < 9; ++i) sum[i % 3] += code[i] >= full ? kUnknown : table[code[i]];
    }
    return sum;
}

// The pictures that scan some channels together.
struct RoundPlan {
    std::uint64_t channels = 0;
    std::array<AxisCode, 2> codes;
    std::array<Indices, 2> pictures;
};

// The use of each picture, in the order of reading.
struct Plan {
    std::size_t black = 0;
    std::vector<std::optional<std::size_t>> whites;  // of the channels
    std::optional<std::size_t> room;
    std::vector<RoundPlan> rounds;
    Indices rest;  // only looked at for faults
    std::uint64_t scanned = 0;

    [[nodiscard]] Indices order() const {
        Indices order{black};
        for (const auto& white : whites)
            if (white) order.push_back(*white);
        if (room) order.push_back(*room);
        for (const RoundPlan& round : rounds)
            for (const Indices& axis : round.pictures)
                order.insert(order.end(), axis.begin(), axis.end());
        order.insert(order.end(), rest.begin(), rest.end());
        return order;
    }
};

Error missing(const std::string& what) {
    return Error("the scan has no " + what + "; take it again with all of its patterns");
}

// The rounds: channels that pictures of columns or rows show together.
std::vector<RoundPlan> roundsOf(const std::vector<config::ScanPicture>& pictures,
                                const Indices& own) {
    std::vector<RoundPlan> rounds;
    for (const std::size_t i : own) {
        const ScanPattern& pattern = pictures[i].pattern;
        if (axisOf(pattern.kind) < 0 || pattern.lit == 0) continue;
        RoundPlan joined{.channels = pattern.lit, .codes = {}, .pictures = {}};
        std::erase_if(rounds, [&](const RoundPlan& round) {
            const bool shares = (round.channels & pattern.lit) != 0;
            if (shares) joined.channels |= round.channels;
            return shares;
        });
        rounds.push_back(joined);
    }
    return rounds;
}

AxisCode codeOf(const std::vector<config::ScanPicture>& pictures, const Indices& axis, int index) {
    AxisCode code{.axis = index};
    for (const std::size_t i : axis) {
        const ScanPattern& pattern = pictures[i].pattern;
        if (isPhase(pattern.kind)) {
            code.hasPhase = true;
            continue;
        }
        code.bits = std::max(code.bits, pattern.step + 1);
        code.finestPixels = pattern.finestPixels;
        code.isPaired |= pattern.inverse;
    }
    return code;
}

// Whether the axis has each pattern exactly once.
bool isComplete(const std::vector<config::ScanPicture>& pictures,
                const Indices& axis,
                const AxisCode& code) {
    std::set<std::tuple<bool, int, bool>> seen;
    for (const std::size_t i : axis) {
        const ScanPattern& pattern = pictures[i].pattern;
        seen.emplace(isPhase(pattern.kind), pattern.step, pattern.inverse);
    }
    const int stripes = code.bits * (code.isPaired ? 2 : 1);
    const int phases = code.hasPhase ? wall::kScanPhaseSteps : 0;
    return code.bits > 0 && seen.size() == axis.size() &&
           static_cast<int>(axis.size()) == stripes + phases;
}

void checkAxis(const std::vector<config::ScanPicture>& pictures,
               const Indices& axis,
               const AxisCode& code,
               int pixels) {
    const std::string name = code.axis == 0 ? "columns" : "rows";
    if (!isComplete(pictures, axis, code)) throw missing("complete set of patterns of " + name);
    const int widest = code.hasPhase ? wall::kScanPeriodPixels / 2 : pixels;
    if (code.bits != wall::scanGrayBits(pixels, code.finestPixels) || code.finestPixels > widest)
        throw Error("the scan's stripes do not name all " + name +
                    " of this rig's pictures; give the rig that was scanned");
}

int mostPixels(const config::Rig& rig, std::uint64_t channels, int axis) {
    int most = 0;
    for (std::size_t c = 0; c < rig.channels.size(); ++c)
        if (config::contains(channels, c)) most = std::max(most, rig.channels[c].sizePixels[axis]);
    return most;
}

void fillRound(RoundPlan& round,
               const std::vector<config::ScanPicture>& pictures,
               const Indices& own,
               const config::Rig& rig) {
    for (const std::size_t i : own) {
        const int axis = axisOf(pictures[i].pattern.kind);
        if (axis >= 0 && (pictures[i].pattern.lit & round.channels) != 0)
            round.pictures.at(static_cast<std::size_t>(axis)).push_back(i);
    }
    for (int axis = 0; axis < 2; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        round.codes.at(at) = codeOf(pictures, round.pictures.at(at), axis);
        checkAxis(pictures,
                  round.pictures.at(at),
                  round.codes.at(at),
                  mostPixels(rig, round.channels, axis));
    }
}

void findLevels(Plan& plan,
                const std::vector<config::ScanPicture>& pictures,
                const Indices& own,
                const config::Rig& rig) {
    const auto find = [&](const auto& fits) -> std::optional<std::size_t> {
        const auto found =
            std::ranges::find_if(own, [&](auto i) { return fits(pictures[i].pattern); });
        return found == own.end() ? std::nullopt : std::optional(*found);
    };
    const auto black = find(config::isBlack);
    if (!black) throw missing("picture of black");
    plan.black = *black;
    plan.room = find([](const ScanPattern& pattern) { return pattern.kind == Kind::Room; });
    for (std::size_t c = 0; c < rig.channels.size(); ++c) {
        plan.whites.push_back(
            find([c](const ScanPattern& pattern) { return isWhiteOf(pattern, c); }));
        if (config::contains(plan.scanned, c) && !plan.whites.back())
            throw missing("white of channel \"" + rig.channels[c].name + "\" alone");
    }
}

Plan planOf(const config::Scan& scan, std::uint32_t camera, const config::Rig& rig) {
    Plan plan;
    Indices own;
    for (std::size_t i = 0; i < scan.pictures.size(); ++i)
        if (scan.pictures[i].camera == camera) own.push_back(i);
    plan.rounds = roundsOf(scan.pictures, own);
    if (plan.rounds.empty()) throw missing("patterns of columns and rows by this camera");
    for (RoundPlan& round : plan.rounds) {
        fillRound(round, scan.pictures, own, rig);
        plan.scanned |= round.channels;
    }
    findLevels(plan, scan.pictures, own, rig);
    Indices used = plan.order();
    std::ranges::sort(used);
    std::ranges::set_difference(own, used, std::back_inserter(plan.rest));
    return plan;
}

// The quantile of every fifth value.
float sampledQuantile(const Plane& values, double share) {
    constexpr std::size_t kStride = 5;
    Plane some;
    for (std::size_t i = 0; i < values.size(); i += kStride) some.push_back(values[i]);
    return quantile(some, share);
}

// Decodes one camera, picture by picture in the order of a plan.
class Decoder {
  public:
    Decoder(PictureSource& source, std::uint32_t camera, const config::Rig& rig)
        : source_{source},
          rig_{rig},
          camera_{camera},
          plan_{planOf(source.scan(), camera, rig)},
          order_{plan_.order()},
          pool_{std::max(1U, std::thread::hardware_concurrency())},
          reader_{source, camera, pool_},
          notes_(rig.channels.size()),
          clipped_(rig.channels.size()),
          litFrom_(rig.channels.size()) {
        view_.channels.resize(rig.channels.size());
    }

    [[nodiscard]] CameraView run() {
        readBlack();
        for (std::size_t c = 0; c < plan_.whites.size(); ++c)
            if (plan_.whites[c]) readWhite(c);
        if (plan_.room) view_.room = lightOfFrame(next());
        for (const RoundPlan& round : plan_.rounds) decodeRound(round);
        for (std::size_t i = 0; i < plan_.rest.size(); ++i) static_cast<void>(next());
        for (const std::size_t c : channelsIn(plan_.scanned)) tidy(c);
        view_.noise = noises_ > 0 ? view_.noise / noises_ : 0;
        view_.faults = faultsOf({.scan = source_.scan(),
                                 .rig = rig_,
                                 .camera = camera_,
                                 .view = view_,
                                 .small = reader_.small(),
                                 .firstBlack = plan_.black,
                                 .channels = notes_});
        return std::move(view_);
    }

  private:
    [[nodiscard]] ScanFrame next() {
        const std::size_t index = order_[read_++];
        ScanFrame frame = reader_.read(
            index, read_ < order_.size() ? std::optional(order_[read_]) : std::nullopt);
        if (frame.pattern->kind == Kind::Level) sample(frame);
        return frame;
    }
    void sample(const ScanFrame& frame) {
        view_.sizePixels = reader_.sizePixels();
        view_.sampleStep = std::max(3, view_.sizePixels.x / kSampleColumns);
        const std::vector<float> table =
            lightOfCodes(frame.picture.bits, source_.scan().cameras[camera_].response);
        Light light = darkness(view_.sizePixels / view_.sampleStep);
        pool_.run(static_cast<std::size_t>(light.sizePixels.y), [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < light.sizePixels.x; ++x)
                light.at(x, y) = sumAround(frame.picture, pixelOfSample(view_, x, y), table) / 9.0F;
        });
        view_.samples.push_back(
            {*frame.pattern, std::move(light), reader_.exposureScale(frame.index)});
    }
    [[nodiscard]] Light lightOfFrame(const ScanFrame& frame) const {
        Light light = lightOf(frame.picture, source_.scan().cameras[camera_].response);
        const float scale = reader_.exposureScale(frame.index);
        for (glm::vec3& rgb : light.rgb) rgb *= scale;
        return light;
    }

    void readBlack() {
        ScanFrame frame = next();
        view_.sizePixels = reader_.sizePixels();
        view_.black = lightOfFrame(frame);
        black_ = std::move(frame.luminance);
    }

    void readWhite(std::size_t channel) {
        const ScanFrame frame = next();
        const auto most = static_cast<float>((1 << frame.picture.bits) - 1);
        const auto full = static_cast<std::uint16_t>(0.995F * most);
        ChannelView& view = view_.channels[channel];
        view.light.resize(black_.size());
        clipped_[channel].resize(black_.size());
        forPixels(pool_, black_.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t p = first; p < last; ++p) {
                view.light[p] = frame.luminance[p] - black_[p];
                const std::uint16_t* code = &frame.picture.rgb[3 * p];
                clipped_[channel][p] = std::max({code[0], code[1], code[2]}) >= full ? 1 : 0;
            }
        });
        litFrom_[channel] = std::max(kLeastLight, kLitShare * sampledQuantile(view.light, 0.98));
        double lit = 0, clipped = 0;
        for (std::size_t p = 0; p < black_.size(); ++p) {
            if (view.light[p] < litFrom_[channel]) continue;
            ++lit;
            clipped += clipped_[channel][p];
        }
        notes_[channel].clipped = lit > 0 ? clipped / lit : 0;
    }

    // The channel of a round that lights a pixel, where no other channel lights it too.
    [[nodiscard]] std::uint8_t ownerOf(const Indices& channels,
                                       std::size_t pixel,
                                       bool hasPhase) const {
        float most = 0, second = 0;
        std::size_t owner = Round::kNobody;
        for (const std::size_t c : channels) {
            const float light = view_.channels[c].light[pixel];
            second = std::max(second, std::min(light, most));
            if (light > most) owner = c;
            most = std::max(light, most);
        }
        if (owner == Round::kNobody || most < litFrom_[owner] || second > kShared * most)
            return Round::kNobody;
        // Stripes can be decoded by their inverse even where white is clipped; phase cannot.
        const bool isBroken = hasPhase && clipped_[owner][pixel] != 0;
        return isBroken ? Round::kNobody : static_cast<std::uint8_t>(owner);
    }

    [[nodiscard]] Round roundOf(const RoundPlan& plan) {
        Round round{.channels = plan.channels,
                    .owner = std::vector<std::uint8_t>(black_.size()),
                    .middle = black_};
        const bool hasPhase = plan.codes[0].hasPhase || plan.codes[1].hasPhase;
        const Indices channels = channelsIn(plan.channels);
        forPixels(pool_, black_.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t p = first; p < last; ++p) {
                round.owner[p] = ownerOf(channels, p, hasPhase);
                for (const std::size_t c : channels)
                    round.middle[p] += 0.5F * view_.channels[c].light[p];
            }
        });
        return round;
    }

    void decodeRound(const RoundPlan& plan) {
        const Round round = roundOf(plan);
        std::vector<Indices> owned(rig_.channels.size());
        for (std::size_t p = 0; p < round.owner.size(); ++p)
            if (round.owner[p] != Round::kNobody) owned[round.owner[p]].push_back(p);
        for (const std::size_t c : channelsIn(plan.channels)) {
            view_.channels[c].place.assign(black_.size(), glm::vec2(kUnknown));
            view_.channels[c].sigma.assign(black_.size(), glm::vec2(kUnknown));
        }
        for (std::size_t axis = 0; axis < 2; ++axis) {
            AxisSignals signals(plan.codes.at(axis), black_.size());
            for (std::size_t i = 0; i < plan.pictures.at(axis).size(); ++i)
                signals.add(next(), round, view_.channels, pool_);
            for (const std::size_t c : channelsIn(plan.channels))
                if (!owned[c].empty()) readAxis(signals, plan.pictures.at(axis), c, owned[c]);
        }
    }

    void readAxis(const AxisSignals& signals,
                  const Indices& pictures,
                  std::size_t channel,
                  const Indices& owned) {
        ChannelView& view = view_.channels[channel];
        const int axis = signals.code.axis;
        const int pixels = rig_.channels[channel].sizePixels[axis];
        const auto make = signals.code.hasPhase ? makePhaseReader : makeStripeReader;
        const auto reader = make(signals, view.light, owned, pixels);
        forPixels(pool_, owned.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const Reading reading = reader->read(owned[i]);
                view.place[owned[i]][axis] = reading.place;
                view.sigma[owned[i]][axis] = reading.sigma;
            }
        });
        settleDoubts(view, axis, view_.sizePixels.x, owned, *reader, pool_);
        view_.noise += reader->noise();
        ++noises_;
        notes_[channel].hasPhase |= signals.code.hasPhase;
        noteStripes(signals, pictures, channel, owned);
    }

    void noteStripes(const AxisSignals& signals,
                     const Indices& pictures,
                     std::size_t channel,
                     const Indices& owned) {
        ChannelNotes& notes = notes_[channel];
        const int pixels = rig_.channels[channel].sizePixels[signals.code.axis];
        for (const std::size_t i : pictures) {
            const ScanPattern& pattern = source_.scan().pictures[i].pattern;
            if (!config::contains(pattern.lit, channel)) continue;
            notes.isTagged |= pattern.tagged;
            if (!signals.code.hasPhase || isPhase(pattern.kind)) continue;
            const ChannelView& view = view_.channels[channel];
            note(notes, i, stripeShift(signals, pattern.step, pixels, view, owned).value_or(0));
        }
    }
    static void note(ChannelNotes& notes, std::size_t picture, double shift) {
        if (std::abs(shift) <= std::abs(notes.shift)) return;
        notes.shift = shift;
        notes.shiftedPicture = picture;
    }

    void tidy(std::size_t channel) {
        ChannelView& view = view_.channels[channel];
        ChannelNotes& notes = notes_[channel];
        const int width = view_.sizePixels.x;
        dropOutliers(view, width, pool_);
        notes.step = stepOf(view, width);
        const glm::ivec2 size = rig_.channels[channel].sizePixels;
        dropBorders(view, notes.step, size);
        if (notes.isTagged) dropTag(view, notes.step, view_.sizePixels, size);
    }

    PictureSource& source_;
    const config::Rig& rig_;
    std::uint32_t camera_;
    Plan plan_;
    Indices order_;
    std::size_t read_ = 0;  // pictures of the order
    WorkerPool pool_;
    FrameReader reader_;
    CameraView view_;
    Plane black_;
    std::vector<ChannelNotes> notes_;
    std::vector<std::vector<std::uint8_t>> clipped_;  // of each channel's white
    Plane litFrom_;                                   // of each channel
    int noises_ = 0;
};

}  // namespace

std::size_t pixelOfSample(const CameraView& view, int x, int y) {
    const int half = view.sampleStep / 2;
    return static_cast<std::size_t>(y * view.sampleStep + half) *
               static_cast<std::size_t>(view.sizePixels.x) +
           static_cast<std::size_t>(x * view.sampleStep + half);
}

CameraView decode(PictureSource& source, std::uint32_t camera, const config::Rig& rig) {
    return Decoder(source, camera, rig).run();
}

}  // namespace aquarama::scan
