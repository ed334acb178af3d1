// SPDX-License-Identifier: Apache-2.0
#include "common/config/adjustments.h"

#include <algorithm>

#include "common/base/log.h"
#include "common/config/adjustments.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

std::size_t channelIn(const TextReader& file,
                      const google::protobuf::Message& part,
                      const std::string& field,
                      const std::string& name,
                      const Rig& rig) {
    const auto found = std::ranges::find(rig.channels, name, &Channel::name);
    if (found != rig.channels.end()) return static_cast<std::size_t>(found - rig.channels.begin());
    std::string names;
    for (const Channel& channel : rig.channels) names += (names.empty() ? "" : ", ") + channel.name;
    file.refuse(part, field, "the rig has no channel \"" + name + "\", only " + names);
}

glm::dvec2 pixelsOf(const v1::PixelPlace& in) {
    return {in.x_px(), in.y_px()};
}

ControlPoint pointFrom(const TextReader& file, const v1::ControlPoint& in, const Rig& rig) {
    if (in.has_picture() == in.has_panorama())
        file.refuse(in, "a point needs one place: picture or panorama");
    const bool isInPicture = in.has_picture();
    return {.channel = channelIn(file, in, "channel", in.channel(), rig),
            .pixelsOf = isInPicture ? PixelsOf::Picture : PixelsOf::Panorama,
            .place = pixelsOf(isInPicture ? in.picture() : in.panorama()),
            .byPixels = {in.right_px(), in.down_px()},
            .radiusPixels = in.radius_px(),
            .source = file.placeOf(in)};
}

MaskedArea maskFrom(const TextReader& file, const v1::MaskedArea& in, const Rig& rig) {
    if ((in.picture_size() > 0) == (in.panorama_size() > 0))
        file.refuse(in, "a mask needs corners of one kind: picture or panorama");
    if (in.picture_size() > 0 && !in.has_channel())
        file.refuse(in, "a mask in a channel's picture needs the channel: name it");
    MaskedArea mask{.softPixels = in.soft_px(), .source = file.placeOf(in)};
    if (in.has_channel()) mask.channel = channelIn(file, in, "channel", in.channel(), rig);
    if (in.picture_size() > 0) mask.pixelsOf = PixelsOf::Picture;
    for (const v1::PixelPlace& corner : in.picture_size() > 0 ? in.picture() : in.panorama())
        mask.corners.push_back(pixelsOf(corner));
    if (mask.corners.size() < 3) file.refuse(in, "a mask needs three corners or more");
    return mask;
}

BlendLimit limitFrom(const TextReader& file, const v1::BlendLimit& in, const Rig& rig) {
    BlendLimit limit{.channel = channelIn(file, in, "channel", in.channel(), rig),
                     .widthPixels = in.width_px(),
                     .source = file.placeOf(in)};
    if (in.has_with()) limit.with = channelIn(file, in, "with", in.with(), rig);
    if (limit.with == limit.channel) file.refuse(in, "with", "a channel blends with another one");
    return limit;
}

// Where a place is in a text; columns count a tab as protobuf does, to the next multiple of eight.
std::size_t offsetOf(const std::string& text, SourcePlace place) {
    std::size_t at = 0;
    for (int line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
    for (int column = 1; column < place.column && at < text.size(); ++at)
        column += text[at] == '\t' ? 8 - (column - 1) % 8 : 1;
    return at;
}

// Past the closing bracket of the message that is opened next; the end where there is none.
std::size_t endOfMessage(const std::string& text, std::size_t at) {
    int depth = 0;
    char quote = 0;
    for (; at < text.size(); ++at) {
        const char c = text[at];
        if (quote != 0) {
            if (c == '\\') ++at;
            if (c == quote) quote = 0;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '#') {
            at = std::min(text.find('\n', at), text.size() - 1);
        } else if (c == '{' || c == '<') {
            ++depth;
        } else if ((c == '}' || c == '>') && --depth == 0) {
            return at + 1;
        }
    }
    return text.size();
}

}  // namespace

std::string withoutEntry(const std::string& text, SourcePlace place) {
    const std::size_t begin = offsetOf(text, place);
    std::size_t end = endOfMessage(text, begin);
    const bool beginsLine = begin == 0 || text[begin - 1] == '\n';
    if (beginsLine && end < text.size() && text[end] == '\n') ++end;
    return text.substr(0, begin) + text.substr(end);
}

Adjustments parseAdjustments(const std::string& text, const std::string& source, const Rig& rig) {
    v1::Adjustments in;
    TextReader file(text, source, in);
    file.check();
    Adjustments adjustments;
    for (const auto& point : in.points()) adjustments.points.push_back(pointFrom(file, point, rig));
    for (const auto& mask : in.masks()) adjustments.masks.push_back(maskFrom(file, mask, rig));
    for (const auto& limit : in.blends()) adjustments.blends.push_back(limitFrom(file, limit, rig));
    return adjustments;
}

Adjustments adjustmentsOf(const Rig& rig) {
    if (rig.adjustments.empty()) return {};
    const auto& content = *rig.files.at(rig.adjustments);
    constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
    if (content.size() > kMostBytes)
        throw Error(rig.adjustments + ": is larger than 1 MiB; name a file of adjustments");
    const std::string text(reinterpret_cast<const char*>(content.data()), content.size());
    return parseAdjustments(text, rig.adjustments, rig);
}

}  // namespace aquarama::config
