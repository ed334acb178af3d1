// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <chrono>
#include <numbers>
#include <set>
#include <sstream>

#include <glm/matrix.hpp>
#include <pugixml.hpp>
#include <spdlog/fmt/chrono.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/formats/archive.h"
#include "common/formats/mpcdi.h"
#include "common/formats/pfm.h"

namespace aquarama::formats {

namespace {

using pugi::xml_node;

constexpr unsigned kParsingExtension =
    pugi::parse_default | pugi::parse_comments | pugi::parse_pi | pugi::parse_ws_pcdata;

// The shortest decimal that is read as this value; 21 digits are enough for every long double.
template <typename Reads>
std::string decimalOf(long double value, const Reads& isAsWanted) {
    std::string text;
    for (int digits = 1; digits <= 21; ++digits) {
        text = fmt::format("{:.{}g}", value, digits);
        if (isAsWanted(*decimalIn(text))) break;
    }
    return text;
}

std::string plain(double value) {
    return decimalOf(value, [&](long double read) { return static_cast<double>(read) == value; });
}

// A list of numbers separated by blanks.
std::string plain(std::span<const float> values) {
    std::string text;
    for (const float value : values)
        text += (text.empty() ? "" : " ") + decimalOf(value, [&](long double read) {
                    return static_cast<float>(read) == value;
                });
    return text;
}

std::string degreesText(double radians) {
    return decimalOf(radians * 180.0L / std::numbers::pi_v<long double>,
                     [&](long double read) { return radiansOf(read) == radians; });
}

std::string now() {
    const auto time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(time));
}

xml_node add(xml_node parent, const char* name) {
    return parent.append_child(name);
}

void addText(xml_node parent, const std::string& name, std::string_view text) {
    parent.append_child(name.c_str()).text().set(std::string(text).c_str());
}

void set(xml_node node, const char* name, const std::string& value) {
    node.append_attribute(name) = value.c_str();
}

// The text of a document, one line for each element.
void indent(xml_node node, std::size_t depth) {
    if (node.first_child().type() != pugi::node_element) return;
    for (xml_node child = node.first_child(); child; child = child.next_sibling()) {
        const std::string line = "\n" + std::string(4 * depth, ' ');
        node.insert_child_before(pugi::node_pcdata, child).set_value(line.c_str());
        indent(child, depth + 1);
    }
    const std::string line = "\n" + std::string(4 * (depth - 1), ' ');
    node.append_child(pugi::node_pcdata).set_value(line.c_str());
}

// Warps finer than a tenth of the picture count as fine, as in other programs.
bool isFine(const FileChannel& channel, Profile profile) {
    if (profile == Profile::Projector) return channel.distortion.has_value();
    return channel.warp && (10 * channel.warp->size.x > channel.sizePixels.x ||
                            10 * channel.warp->size.y > channel.sizePixels.y);
}

bool isColoured(const FileChannel& channel) {
    return channel.black || (channel.blend && channel.blend->components == 3);
}

// The part of an entry's name that comes from a channel's name.
std::string entryPart(std::string name) {
    constexpr std::size_t kMost = 200;
    name.resize(std::min(name.size(), kMost));
    std::ranges::replace_if(
        name,
        [](char c) { return c < 0x20 || c > 0x7E || c == '/' || c == '\\' || c == ':'; },
        '_');
    return name;
}

[[noreturn]] void refuse(const FileChannel& channel, const std::string& what) {
    throw Error(fmt::format(
        "channel \"{}\" cannot be written as MPCDI: {}", printable(channel.name), what));
}

// Writes the files of an archive for a wall.
class Writer {
  public:
    Writer(const WallFile& wall, int version) : wall_(wall), version_(version) {}
    [[nodiscard]] std::vector<ArchiveFile> write();

  private:
    void check() const;
    void addRoot();
    void addBuffers(xml_node display);
    void addRegion(xml_node buffer, const FileChannel& channel);
    void addPose(xml_node region, const FileChannel& channel);
    void addFileset(const FileChannel& channel);
    void addGeometry(xml_node fileset, const FileChannel& channel);
    void addWarp(xml_node element,
                 const std::string& stem,
                 const Warp& warp,
                 const FileChannel& channel);
    void addMask(xml_node fileset,
                 const char* name,
                 const std::string& stem,
                 const std::optional<Mask>& mask,
                 const FileChannel& channel);
    void reserveNames(const std::vector<Extension>& extensions);
    [[nodiscard]] xml_node ownExtension();
    void addColour(const FileChannel& channel);
    void addMark(const FileChannel& channel, const char* element, const TexelMeaning& meaning);
    void addExtensions(xml_node node, std::string_view place, const std::vector<Extension>& all);
    void appendExtensions();
    [[nodiscard]] xml_node extensionSet();
    [[nodiscard]] std::vector<std::byte> manifest() const;
    [[nodiscard]] std::string newName(const std::string& stem, const char* ending);
    // Of v1 and of v2.
    [[nodiscard]] const char* spelt(const char* first, const char* second) const {
        return version_ == 1 ? first : second;
    }

    const WallFile& wall_;
    int version_;
    pugi::xml_document document_;
    xml_node root_, files_, own_;
    std::vector<std::pair<xml_node, const Extension*>> extensions_;  // to be appended at the end
    std::vector<ArchiveFile> entries_;
    std::set<std::string> names_{"mpcdi.xml"};  // of the entries, in lower case
};

void Writer::check() const {
    std::set<std::string> names;
    for (const FileChannel& channel : wall_.channels) {
        if (channel.name.empty()) refuse(channel, "it has no name; give it one");
        if (!names.insert(channel.name).second)
            refuse(channel, "another has its name; give it another");
        if (std::min(channel.sizePixels.x, channel.sizePixels.y) < 1)
            refuse(channel, "the size of its picture is not known; say it");
        if (const char* missing = missingOf(channel, wall_.profile))
            refuse(channel,
                   fmt::format("it has no {}, which its profile needs; choose another", missing));
        const std::string fault = channel.colour ? faultOf(*channel.colour) : "";
        if (!fault.empty()) refuse(channel, "its colour has " + fault);
    }
    if (names.empty()) throw Error("a wall without channels cannot be written as MPCDI; add one");
}

// Reserves the names of the files of extensions, which stay the same.
void Writer::reserveNames(const std::vector<Extension>& extensions) {
    for (const Extension& extension : extensions)
        for (const ArchiveFile& file : extension.files) names_.insert(lowered(file.first));
}

std::string Writer::newName(const std::string& stem, const char* ending) {
    std::string name = stem + ending;
    for (int i = 2; !names_.insert(lowered(name)).second; ++i)
        name = fmt::format("{}-{}{}", stem, i, ending);
    return name;
}

void Writer::addExtensions(xml_node node,
                           std::string_view place,
                           const std::vector<Extension>& all) {
    for (const Extension& extension : all)
        if (extension.place == place) extensions_.emplace_back(node, &extension);
}

xml_node Writer::extensionSet() {
    const xml_node known = root_.child("extensionSet");
    return known ? known : add(root_, "extensionSet");
}

void Writer::addRoot() {
    root_ = document_.append_child("MPCDI");
    const auto any = [&](const auto& is) { return std::ranges::any_of(wall_.channels, is); };
    const int fine =
        any([&](const FileChannel& channel) { return isFine(channel, wall_.profile); });
    const int colours = any(isColoured);
    set(root_, "profile", std::string(kProfileNames.at(static_cast<std::size_t>(wall_.profile))));
    set(root_, "date", wall_.date.empty() ? now() : wall_.date);
    if (version_ == 1) {
        set(root_, "level", std::to_string(1 + colours + 2 * fine));
    } else {
        set(root_, "geometry", std::to_string(1 + fine));
        set(root_, "color", std::to_string(1 + colours));
    }
    set(root_, "version", spelt("1.0", "2.0"));
}

void Writer::addPose(xml_node region, const FileChannel& channel) {
    if (channel.frustum) {
        const xml_node frustum = add(region, "frustum");
        for (const auto& [name, angle] : kAngleNames)
            addText(frustum, name, degreesText((*channel.frustum).*angle));
    }
    if (!channel.coordinateFrame) return;
    const xml_node frame = add(region, "coordinateFrame");
    for (const auto& [name, axis] : kAxisNames)
        for (int i = 0; i < 3; ++i)
            addText(frame,
                    fmt::format("{}{}", name, "xyz"[i]),
                    plain(((*channel.coordinateFrame).*axis)[i]));
}

void Writer::addRegion(xml_node buffer, const FileChannel& channel) {
    const xml_node region = add(buffer, "region");
    const long double y = 1.0L - channel.corner.y - channel.extent.y;
    const auto isTop = [&](long double read) {
        return topOf(read, channel.extent.y) == channel.corner.y;
    };
    set(region, "id", channel.name);
    set(region, spelt("Xresolution", "xResolution"), std::to_string(channel.sizePixels.x));
    set(region, spelt("Yresolution", "yResolution"), std::to_string(channel.sizePixels.y));
    set(region, "x", plain(channel.corner.x));
    set(region, "y", decimalOf(std::max(0.0L, y), isTop));
    set(region, "xsize", plain(channel.extent.x));
    set(region, "ysize", plain(channel.extent.y));
    addPose(region, channel);
    addExtensions(region, "region", channel.extensions);
    addExtensions(buffer, "buffer", channel.extensions);
}

void Writer::addBuffers(xml_node display) {
    for (const FileChannel& channel : wall_.channels) {
        xml_node buffer = display.find_child_by_attribute("buffer", "id", channel.buffer.c_str());
        if (!buffer) {
            buffer = add(display, "buffer");
            set(buffer, "id", channel.buffer);
            if (channel.bufferPixels.x > 0) {
                const glm::ivec2 size = channel.bufferPixels;
                set(buffer, spelt("Xresolution", "xResolution"), std::to_string(size.x));
                set(buffer, spelt("Yresolution", "yResolution"), std::to_string(size.y));
            }
        }
        addRegion(buffer, channel);
    }
}

xml_node Writer::ownExtension() {
    if (own_) return own_;
    own_ = add(extensionSet(), "extension");
    set(own_, "Name", kOwnExtension);
    set(own_, "hasExternalFiles", "false");
    return own_;
}

void Writer::addColour(const FileChannel& channel) {
    const xml_node colour = add(ownExtension(), "colour");
    set(colour, "region", channel.name);
    const glm::mat3 rows = glm::transpose(channel.colour->mix);
    addText(colour, "mix", plain(std::span(&rows[0][0], kMixNumbers)));
    for (std::size_t i = 0; i < kPrimaryNames.size(); ++i)
        addText(colour, kPrimaryNames[i], plain(channel.colour->response[i]));
}

// Whether the values alone would suggest another way of storage.
void Writer::addMark(const FileChannel& channel, const char* element, const TexelMeaning& meaning) {
    const xml_node warp = add(ownExtension(), "warp");
    set(warp, "region", channel.name);
    set(warp, "file", element);
    set(warp,
        "sampling",
        std::string(kSamplingNames.at(static_cast<std::size_t>(meaning.sampling))));
    set(warp, "values", std::string(kStoredNames.at(static_cast<std::size_t>(meaning.stored))));
}

void Writer::addWarp(xml_node element,
                     const std::string& stem,
                     const Warp& warp,
                     const FileChannel& channel) {
    const bool isScreen = wall_.profile == Profile::Screen;
    const TexelMeaning meaning{.profile = wall_.profile,
                               .corner = channel.corner,
                               .extent = channel.extent,
                               .stored = isScreen ? Stored::Places : warp.stored,
                               .sampling = warp.sampling};
    const Pfm pfm = pfmOf(warp, meaning);
    TexelMeaning guess = meaning;
    guessMeaning(guess, pfm);
    if (guess.stored != meaning.stored || guess.sampling != meaning.sampling)
        addMark(channel, element.name(), meaning);
    const std::string entry = newName(stem + "-" + entryPart(channel.name), ".pfm");
    addText(element, "path", entry);
    entries_.emplace_back(entry, encodePfm(pfm));
}

void Writer::addGeometry(xml_node fileset, const FileChannel& channel) {
    const xml_node geometry = add(fileset, "geometryWarpFile");
    addWarp(geometry, "GeometryWarpFile", *channel.warp, channel);
    const bool isMetric = wall_.profile == Profile::Screen || wall_.profile == Profile::Projector;
    if (isMetric) addText(geometry, "geometricUnit", "m");
    addText(geometry, "interpolation", channel.interpolation);
    if (isMetric || wall_.origin != DataOrigin::Unknown)
        addText(geometry,
                spelt("originof3DData", "originOf3DData"),
                kOriginNames.at(static_cast<std::size_t>(wall_.origin)));
}

// Adds an empty element where there is none, as the standard requires it.
void Writer::addMask(xml_node fileset,
                     const char* name,
                     const std::string& stem,
                     const std::optional<Mask>& mask,
                     const FileChannel& channel) {
    const xml_node element = add(fileset, name);
    if (!mask) return;
    const std::string file = newName(stem + "-" + entryPart(channel.name), ".png");
    addText(element, "path", file);
    addText(element, "componentDepth", std::to_string(mask->components));
    addText(element, "bitDepth", std::to_string(mask->bits));
    addText(element, "gammaEmbedded", plain(mask->gamma));
    entries_.emplace_back(file,
                          encodePng({.sizePixels = mask->size,
                                     .components = mask->components,
                                     .bits = mask->bits,
                                     .codes = mask->codes},
                                    PngMeaning::Unsaid));
}

void Writer::addFileset(const FileChannel& channel) {
    const bool hasFiles = channel.warp || channel.blend || channel.black || channel.distortion;
    const auto isHere = [](const Extension& extension) { return extension.place == "fileset"; };
    if (!hasFiles && std::ranges::none_of(channel.extensions, isHere)) return;
    const xml_node fileset = add(files_, "fileset");
    set(fileset, "region", channel.name);
    if (channel.warp) addGeometry(fileset, channel);
    addMask(fileset, "alphaMap", "AlphaMap", channel.blend, channel);
    if (channel.black) addMask(fileset, "betaMap", "BetaMap", channel.black, channel);
    if (channel.distortion)
        addWarp(add(fileset, "distortionMap"), "DistortionMapFile", *channel.distortion, channel);
    addExtensions(fileset, "fileset", channel.extensions);
}

void Writer::appendExtensions() {
    for (auto& [node, extension] : extensions_) {
        const pugi::xml_parse_result result =
            node.append_buffer(extension->xml.data(), extension->xml.size(), kParsingExtension);
        if (!result)
            throw Error(
                fmt::format("an extension of \"{}\" is no XML ({}); mend it or leave it out",
                            printable(node.name()),
                            result.description()));
        entries_.insert(entries_.end(), extension->files.begin(), extension->files.end());
    }
}

std::vector<std::byte> Writer::manifest() const {
    std::ostringstream text;
    text << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    root_.print(text, "", pugi::format_raw);
    text << "\n";
    const std::string whole = text.str();
    const auto bytes = std::as_bytes(std::span(whole));
    return {bytes.begin(), bytes.end()};
}

std::vector<ArchiveFile> Writer::write() {
    check();
    addRoot();
    reserveNames(wall_.extensions);
    for (const FileChannel& channel : wall_.channels) reserveNames(channel.extensions);
    const xml_node display = add(root_, "display");
    files_ = add(root_, "files");
    addBuffers(display);
    for (const FileChannel& channel : wall_.channels) {
        addFileset(channel);
        if (channel.colour) addColour(channel);
    }
    addExtensions(root_, "MPCDI", wall_.extensions);
    addExtensions(display, "display", wall_.extensions);
    addExtensions(files_, "files", wall_.extensions);
    const auto isInSet = [](const Extension& extension) {
        return extension.place == "extensionSet";
    };
    if (std::ranges::any_of(wall_.extensions, isInSet))
        addExtensions(extensionSet(), "extensionSet", wall_.extensions);
    indent(root_, 1);
    appendExtensions();
    entries_.insert(entries_.begin(), {"mpcdi.xml", manifest()});
    return std::move(entries_);
}

}  // namespace

std::vector<std::byte> encodeMpcdi(const WallFile& wall, int version) {
    assert(version == 1 || version == 2);
    return encodeArchive(Writer(wall, version).write());
}

void writeMpcdi(const std::string& path, const WallFile& wall, int version) {
    writeWhole(path, encodeMpcdi(wall, version));
}

}  // namespace aquarama::formats
