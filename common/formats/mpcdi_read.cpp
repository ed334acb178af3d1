// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <pugixml.hpp>

#include "common/base/characters.h"
#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/formats/archive.h"
#include "common/formats/mpcdi.h"
#include "common/formats/pfm.h"

namespace aquarama::formats {

namespace {

using pugi::xml_node;
using Bytes = std::span<const std::byte>;

constexpr std::size_t kMostManifestBytes = std::size_t{8} << 20;
constexpr std::size_t kMostRegions = 1024;
constexpr double kMostPixels = 65536;
constexpr double kLeastExtent = 1e-4;
constexpr std::size_t kMostExtensionBytes = std::size_t{64} << 20;
// White space in extensions is kept; no entity is ever looked up.
constexpr unsigned kParsing =
    pugi::parse_default | pugi::parse_comments | pugi::parse_pi | pugi::parse_ws_pcdata;

// The known children of each element. Everything else is kept as an Extension.
const std::map<std::string, std::vector<std::string>, std::less<>> kKnown{
    {"MPCDI", {"display", "files", "fileset", "extensionSet"}},
    {"display", {"buffer"}},
    {"buffer", {"region"}},
    {"region", {"frustum", "coordinateFrame"}},
    {"files", {"fileset"}},
    {"fileset", {"geometryWarpFile", "alphaMap", "betaMap", "distortionMap"}},
    {"extensionSet", {}},
};

// The children of an element with this name, in any case.
std::vector<xml_node> elements(xml_node parent, std::string_view name) {
    std::vector<xml_node> found;
    for (const xml_node node : parent.children())
        if (node.type() == pugi::node_element && sameName(node.name(), name)) found.push_back(node);
    return found;
}

// The first of them, or none.
xml_node element(xml_node parent, std::string_view name) {
    const std::vector<xml_node> found = elements(parent, name);
    return found.empty() ? xml_node() : found.front();
}

std::string textOf(xml_node node) {
    std::string text;
    for (const xml_node part : node.children())
        if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata)
            text += part.value();
    return std::string(trimmed(text));
}

// The file that an element names; empty where it names none.
std::string pathOf(xml_node node) {
    return textOf(element(node, "path"));
}

std::string attribute(xml_node node, std::string_view name) {
    for (const pugi::xml_attribute attribute : node.attributes())
        if (sameName(attribute.name(), name)) return attribute.value();
    return "";
}

// The index of a name in a list, in any case.
template <std::size_t count>
std::optional<std::size_t> indexOf(const std::array<std::string_view, count>& names,
                                   std::string_view name) {
    const auto found =
        std::ranges::find_if(names, [&](std::string_view known) { return sameName(known, name); });
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

// An element with what it inherits of namespaces said in itself, so that it can stand elsewhere.
std::string xmlOf(xml_node node) {
    const xml_node top =
        node.root().find_child([](xml_node child) { return child.type() == pugi::node_element; });
    for (const pugi::xml_attribute declared : top.attributes())
        if (std::string_view(declared.name()).starts_with("xmlns") &&
            !node.attribute(declared.name()))
            node.append_attribute(declared.name()) = declared.value();
    std::ostringstream text;
    node.print(text, "", pugi::format_raw);
    return text.str();
}

void append(std::vector<Extension>& to, std::vector<Extension> more) {
    to.insert(to.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
}

// All texts in an element that may be names of files, in lower case.
std::set<std::string> wordsOf(std::string_view xml) {
    std::set<std::string> words;
    while (!xml.empty()) {
        const std::size_t end = std::min(xml.find_first_of("\"'<>"), xml.size());
        std::string_view word = trimmed(xml.substr(0, end));
        if (word.starts_with("./")) word.remove_prefix(2);
        words.insert(lowered(word));
        xml.remove_prefix(std::min(xml.size(), end + 1));
    }
    return words;
}

// The extension to which a file of the archive belongs: one that mentions it; for a file that
// nothing mentions or uses, the first extension that says it has files.
class FileOwners {
  public:
    void add(Extension& extension) {
        for (const std::string& word : wordsOf(extension.xml)) mentioned_.emplace(word, &extension);
        const bool hasFiles =
            lowered(extension.xml).find("hasexternalfiles=\"true\"") != std::string::npos;
        if (other_ == nullptr && hasFiles) other_ = &extension;
    }
    // Null: the file belongs to none.
    [[nodiscard]] Extension* of(const std::string& name, bool isUsed) const {
        const auto found = mentioned_.find(lowered(name));
        if (found != mentioned_.end()) return found->second;
        return isUsed ? nullptr : other_;
    }

  private:
    std::map<std::string, Extension*> mentioned_;
    Extension* other_ = nullptr;
};

// The length of a unit in metres; 0 for an unknown one.
double metresOf(std::string_view unit) {
    static const std::map<std::string, double, std::less<>> kMetres{{"mm", 0.001},
                                                                    {"cm", 0.01},
                                                                    {"dm", 0.1},
                                                                    {"m", 1},
                                                                    {"in", 0.0254},
                                                                    {"ft", 0.3048},
                                                                    {"yd", 0.9144},
                                                                    {"2d", 1},
                                                                    {"unknown", 1},
                                                                    {"", 1}};
    const auto found = kMetres.find(lowered(unit));
    return found == kMetres.end() ? 0 : found->second;
}

// A manifest. Its name in the archive is empty where it is the file itself.
struct Manifest {
    std::string source;
    std::string name;
    Archive* archive = nullptr;

    // The folder of the manifest in the archive, with a slash at its end; empty at the root.
    [[nodiscard]] std::string folder() const { return name.substr(0, name.rfind('/') + 1); }
    // The entry of a path in the manifest: from its folder, else from the root.
    [[nodiscard]] std::optional<std::string> entryOf(std::string path) const {
        std::ranges::replace(path, '\\', '/');
        for (const std::string& from : {folder(), std::string()}) {
            const std::filesystem::path whole(from + path);
            if (auto found = archive->find(whole.lexically_normal().string())) return found;
        }
        return std::nullopt;
    }

    // For errors in the manifest, and in a file beside it.
    [[nodiscard]] std::string where() const { return name.empty() ? source : whereOf(name); }
    [[nodiscard]] std::string whereOf(const std::string& file) const {
        return source + ": " + printable(file);
    }
};

// Reads the wall of one manifest.
class Reader {
  public:
    Reader(const Manifest& manifest, const ReadOptions& options)
        : manifest_(manifest), options_(options) {}
    WallFile read(xml_node root);

  private:
    // The error for this place of the file.
    [[noreturn]] void refuse(const std::string& where, const std::string& what) const {
        throw Error(manifest_.where() + ": " + printable(where) + " " + printable(what) +
                    "; export it anew");
    }

    void readHead(xml_node root);
    void readOwnExtension(xml_node extension);
    void readColour(xml_node node);
    void giveColours();
    void readDisplay(xml_node display);
    void readRegion(xml_node buffer, xml_node node);
    void readPlace(xml_node buffer, xml_node node, FileChannel& channel) const;
    void readFiles(xml_node root);
    void readFileset(xml_node node);
    void readGeometry(xml_node fileset, FileChannel& channel);
    void readOrigin(xml_node geometry);
    void readInterpolation(xml_node geometry, FileChannel& channel);
    void say(const std::string& what);
    void sayKept(xml_node node, const std::string& place);
    void requirePoses() const;
    void keepFiles();

    [[nodiscard]] FileChannel& channelOf(const std::string& region);
    [[nodiscard]] std::vector<Extension> unknownIn(xml_node parent, const std::string& place);
    [[nodiscard]] long double number(std::string_view text, const std::string& name) const;
    [[nodiscard]] std::vector<float> numbersOf(xml_node node, const char* name) const;
    [[nodiscard]] long double numberOr(xml_node node, const char* name, double otherwise) const;
    [[nodiscard]] long double fraction(xml_node region, const char* name, double otherwise) const;
    [[nodiscard]] glm::ivec2 pixelsOf(xml_node node) const;
    [[nodiscard]] Frustum frustumOf(xml_node node) const;
    [[nodiscard]] CoordinateFrame frameOf(xml_node node) const;
    [[nodiscard]] std::vector<std::byte> contentOf(xml_node element);
    [[nodiscard]] Pfm mapOf(xml_node element);
    [[nodiscard]] std::optional<Warp> warpOf(xml_node element, const FileChannel& channel);
    [[nodiscard]] std::optional<Mask> maskOf(xml_node element, double gamma);

    const Manifest& manifest_;
    const ReadOptions& options_;
    WallFile wall_;
    std::string where_ = "MPCDI";   // the element that is being read, for errors
    std::set<std::string> filled_;  // regions whose files were read
    std::set<std::string> used_;    // entries of the archive
    std::size_t maskBytes_ = 0, extensionBytes_ = 0;
    // The storage of warps in our own extension, by region and element.
    std::map<std::pair<std::string, std::string>, std::pair<Sampling, Stored>> own_;
    std::map<std::string, ChannelColour> colours_;  // of our own extension, by region
};

long double Reader::number(std::string_view text, const std::string& name) const {
    const auto number = decimalIn(trimmed(text));
    const std::string plain = plainNumber(text);
    if (!number)
        refuse(where_,
               fmt::format("has a {} of \"{}\", which is no number{}",
                           name,
                           text,
                           plain.empty() ? "" : fmt::format(" ({} would be one)", plain)));
    return *number;
}

long double Reader::numberOr(xml_node node, const char* name, double otherwise) const {
    const std::string text = attribute(node, name);
    return text.empty() ? otherwise : number(text, name);
}

long double Reader::fraction(xml_node region, const char* name, double otherwise) const {
    const long double value = numberOr(region, name, otherwise);
    if (!(value >= 0 && value <= 1))
        refuse(where_, fmt::format("has a {} of {}, outside of 0 to 1", name, value));
    return value;
}

// Keeps the unknown children of an element.
std::vector<Extension> Reader::unknownIn(xml_node parent, const std::string& place) {
    const std::vector<std::string>& known = kKnown.at(place);
    std::vector<Extension> found;
    for (const xml_node node : parent.children()) {
        const bool isOwn = sameName(attribute(node, "Name"), kOwnExtension);
        const bool isKnown = std::ranges::any_of(
            known, [&](const std::string& name) { return sameName(name, node.name()); });
        if (node.type() != pugi::node_element || isKnown || isOwn) continue;
        found.push_back({.xml = xmlOf(node), .files = {}, .place = place});
        sayKept(node, place);
        extensionBytes_ += sizeof(Extension) + found.back().xml.size();
        if (extensionBytes_ > kMostExtensionBytes) refuse(where_, "has too many extensions");
    }
    return found;
}

// The remark about an extension, which is for another program, or about an unknown element.
void Reader::sayKept(xml_node node, const std::string& place) {
    const std::string name = attribute(node, "Name");
    say(fmt::format(
        "<{}{}> in <{}> is kept but not obeyed: compare the picture with the producer's",
        node.name(),
        name.empty() ? "" : fmt::format(" Name=\"{}\"", name),
        place));
}

void Reader::say(const std::string& what) {
    remark(wall_.remarks, manifest_.where() + ": " + printable(where_) + ": " + printable(what));
}

// The size in an element; 0 by 0 where it has none.
glm::ivec2 Reader::pixelsOf(xml_node node) const {
    const long double width = numberOr(node, "Xresolution", 0);
    const long double height = numberOr(node, "Yresolution", 0);
    const auto isPixels = [](long double n) {
        return n >= 0 && n <= kMostPixels && n == std::floor(n);
    };
    if (!isPixels(width) || !isPixels(height) || (width == 0) != (height == 0))
        refuse(where_, fmt::format("has a resolution of {} x {} pixels", width, height));
    return {static_cast<int>(width), static_cast<int>(height)};
}

Frustum Reader::frustumOf(xml_node node) const {
    Frustum frustum;
    for (const auto& [name, angle] : kAngleNames) {
        const xml_node said = element(node, name);
        if (!said) refuse(where_, fmt::format("has a frustum without {}", name));
        frustum.*angle = radiansOf(number(textOf(said), name));
    }
    return frustum;
}

CoordinateFrame Reader::frameOf(xml_node node) const {
    CoordinateFrame frame;
    for (const auto& [name, axis] : kAxisNames)
        for (int i = 0; i < 3; ++i) {
            const std::string axisName = fmt::format("{}{}", name, "xyz"[i]);
            const xml_node said = element(node, axisName);
            if (!said) refuse(where_, "has a coordinateFrame without " + axisName);
            (frame.*axis)[i] = static_cast<double>(number(textOf(said), axisName));
        }
    return frame;
}

void Reader::readHead(xml_node root) {
    const std::string said = attribute(root, "profile");
    const std::string_view profile = trimmed(said);
    const auto index = indexOf(kProfileNames, sameName(profile, "a3d") ? "a3" : profile);
    if (!index)
        refuse(where_, fmt::format("has the profile \"{}\", not 2d, 3d, a3 or sl", profile));
    wall_.profile = static_cast<Profile>(*index);
    const std::string version = attribute(root, "version");
    const std::string_view major = trimmed(std::string_view(version).substr(0, version.find('.')));
    if (!major.empty() && major != "1" && major != "2")
        refuse(where_, fmt::format("is of version \"{}\", not 1 or 2", version));
    wall_.date = attribute(root, "date");
}

void Reader::readOwnExtension(xml_node extension) {
    if (!sameName(attribute(extension, "Name"), kOwnExtension)) return;
    for (const xml_node warp : elements(extension, "warp")) {
        const auto sampling = indexOf(kSamplingNames, attribute(warp, "sampling"));
        const auto stored = indexOf(kStoredNames, attribute(warp, "values"));
        if (!sampling || !stored)
            refuse("extension Aquarama", "has a warp of no known sampling or values");
        own_[{attribute(warp, "region"), attribute(warp, "file")}] = {
            static_cast<Sampling>(*sampling), static_cast<Stored>(*stored)};
    }
    for (const xml_node colour : elements(extension, "colour")) readColour(colour);
}

// The numbers of a list separated by blanks.
std::vector<float> Reader::numbersOf(xml_node node, const char* name) const {
    const std::string text = textOf(element(node, name));
    std::vector<float> numbers;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = std::min(rest.find_first_of(" \t\r\n"), rest.size());
        const long double value = number(rest.substr(0, end), name);
        if (numbers.size() == kMostResponses || std::abs(value) > kMostMix)
            refuse(where_, fmt::format("has too many or too large numbers as its {}", name));
        numbers.push_back(static_cast<float>(value));
        rest = trimmed(rest.substr(end));
    }
    return numbers;
}

void Reader::readColour(xml_node node) {
    const std::string region = attribute(node, "region");
    where_ = fmt::format("colour of region \"{}\"", region);
    ChannelColour colour;
    const std::vector<float> mix = numbersOf(node, "mix");
    if (mix.size() != kMixNumbers)
        refuse(where_, fmt::format("has a mix of {} numbers, not {}", mix.size(), kMixNumbers));
    colour.mix = glm::transpose(glm::make_mat3(mix.data()));
    for (std::size_t i = 0; i < kPrimaryNames.size(); ++i)
        colour.response[i] = numbersOf(node, kPrimaryNames[i]);
    const std::string fault = faultOf(colour);
    if (!fault.empty()) refuse(where_, "has " + fault);
    if (!colours_.emplace(region, std::move(colour)).second) refuse(where_, "is there twice");
    where_ = "MPCDI";
}

void Reader::giveColours() {
    for (FileChannel& channel : wall_.channels)
        if (auto found = colours_.extract(channel.name)) channel.colour = std::move(found.mapped());
    if (!colours_.empty())
        refuse(fmt::format("colour of region \"{}\"", colours_.begin()->first),
               "is for a region that is not there");
}

// Sets the channel's part of its buffer, in pixels and as a rectangle.
void Reader::readPlace(xml_node buffer, xml_node node, FileChannel& channel) const {
    channel.buffer = attribute(buffer, "id");
    channel.bufferPixels = pixelsOf(buffer);
    channel.sizePixels = pixelsOf(node);
    if (channel.sizePixels.x == 0)
        channel.sizePixels = options_.sizePixels.value_or(channel.bufferPixels);
    channel.extent = {fraction(node, "xsize", 1), fraction(node, "ysize", 1)};
    if (std::min(channel.extent.x, channel.extent.y) < kLeastExtent)
        refuse(where_, "takes nothing of its buffer");
    channel.corner = {fraction(node, "x", 0), topOf(fraction(node, "y", 0), channel.extent.y)};
}

void Reader::readRegion(xml_node buffer, xml_node node) {
    FileChannel channel;
    channel.name = attribute(node, "id");
    where_ = fmt::format("region \"{}\"", channel.name);
    if (channel.name.empty()) refuse("a region", "has no id");
    const auto isSame = [&](const FileChannel& known) { return known.name == channel.name; };
    if (std::ranges::any_of(wall_.channels, isSame)) refuse(where_, "is there twice");
    if (wall_.channels.size() == kMostRegions)
        refuse("buffer", fmt::format("has more than {} regions", kMostRegions));
    readPlace(buffer, node, channel);
    if (const xml_node frustum = element(node, "frustum")) channel.frustum = frustumOf(frustum);
    if (const xml_node frame = element(node, "coordinateFrame"))
        channel.coordinateFrame = frameOf(frame);
    channel.extensions = unknownIn(node, "region");
    wall_.channels.push_back(std::move(channel));
}

FileChannel& Reader::channelOf(const std::string& region) {
    const auto found = std::ranges::find(wall_.channels, region, &FileChannel::name);
    if (found == wall_.channels.end()) refuse(where_, "is for a region that is not there");
    if (!filled_.insert(region).second) refuse(where_, "is there twice");
    return *found;
}

std::vector<std::byte> Reader::contentOf(xml_node element) {
    const std::string path = pathOf(element);
    if (manifest_.archive == nullptr)
        refuse(where_,
               fmt::format("names \"{}\", but this is a manifest without its archive", path));
    const std::optional<std::string> entry = manifest_.entryOf(path);
    if (!entry)
        refuse(where_,
               fmt::format(
                   "names \"{}\" as its {}, which is not in the archive", path, element.name()));
    used_.insert(*entry);
    return manifest_.archive->read(*entry);
}

// The float map that an element names; the user may say that its rows are upside down.
Pfm Reader::mapOf(xml_node element) {
    Pfm pfm = decodePfm(contentOf(element), manifest_.whereOf(pathOf(element)));
    if (options_.upsideDown) turnOver(pfm);
    const std::string scale = scaleRemark(pfm);
    if (!scale.empty()) say(fmt::format("{}: {}", pathOf(element), scale));
    return pfm;
}

std::optional<Warp> Reader::warpOf(xml_node element, const FileChannel& channel) {
    if (pathOf(element).empty()) return std::nullopt;
    Pfm pfm = mapOf(element);
    TexelMeaning meaning{
        .profile = wall_.profile,
        .corner = channel.corner,
        .extent = channel.extent,
        .unitMetres = metresOf(textOf(formats::element(element, "geometricUnit")))};
    if (meaning.unitMetres == 0) refuse(where_, "has an unknown geometricUnit");
    guessMeaning(meaning, pfm);
    if (const auto own = own_.find({channel.name, element.name()}); own != own_.end())
        std::tie(meaning.sampling, meaning.stored) = own->second;
    meaning.sampling = options_.sampling.value_or(meaning.sampling);
    if (meaning.profile == Profile::Screen) meaning.stored = Stored::Places;
    return formats::warpOf(std::move(pfm), meaning);
}

// Reads a mask. gamma: where the file has none.
std::optional<Mask> Reader::maskOf(xml_node element, double gamma) {
    if (pathOf(element).empty()) return std::nullopt;
    PngPicture png = decodePng(contentOf(element), manifest_.whereOf(pathOf(element)));
    maskBytes_ += png.codes.size() * sizeof(png.codes[0]);
    if (maskBytes_ > kMostArchiveBytes) refuse(where_, "has too large a mask for so many others");
    const std::string said = textOf(formats::element(element, "gammaEmbedded"));
    if (!said.empty()) gamma = static_cast<double>(number(said, "gammaEmbedded"));
    if (!(gamma > 0 && gamma <= 100))
        refuse(where_, fmt::format("has a gammaEmbedded of {}", gamma));
    return Mask{.size = png.sizePixels,
                .components = png.components,
                .bits = png.bits,
                .gamma = gamma,
                .codes = std::move(png.codes)};
}

void Reader::readOrigin(xml_node geometry) {
    const std::string said = textOf(element(geometry, "originOf3DData"));
    const auto index = indexOf(kOriginNames, said);
    if (!said.empty() && !index)
        say(
            fmt::format("originOf3DData \"{}\" is not known: where the points are measured from is "
                        "taken as the rig says",
                        said));
    const auto origin = static_cast<DataOrigin>(index.value_or(0));
    if (origin == DataOrigin::Unknown) return;
    if (wall_.origin != DataOrigin::Unknown && wall_.origin != origin)
        refuse(where_, "has another originOf3DData than the filesets before");
    wall_.origin = origin;
}

// Reads the interpolation, kept for a round trip. It has no effect where samples are as dense as
// pixels.
void Reader::readInterpolation(xml_node geometry, FileChannel& channel) {
    const std::string said = textOf(element(geometry, "interpolation"));
    for (const char* known : {"keystone", "smooth"})
        if (sameName(said, known)) channel.interpolation = known;
    if (channel.interpolation != "linear")
        say(fmt::format("interpolation \"{}\" is taken as linear: export a denser map", said));
}

void Reader::readGeometry(xml_node fileset, FileChannel& channel) {
    const xml_node geometry = element(fileset, "geometryWarpFile");
    readOrigin(geometry);
    readInterpolation(geometry, channel);
    channel.warp = warpOf(geometry, channel);
    channel.distortion = warpOf(element(fileset, "distortionMap"), channel);
    if (channel.sizePixels.x == 0 && channel.warp) channel.sizePixels = channel.warp->size;
}

void Reader::readFileset(xml_node node) {
    const std::string region = attribute(node, "region");
    where_ = fmt::format("fileset \"{}\"", region);
    FileChannel& channel = channelOf(region);
    readGeometry(node, channel);
    channel.blend = maskOf(element(node, "alphaMap"), 1);
    channel.black = maskOf(element(node, "betaMap"), channel.blend ? channel.blend->gamma : 1);
    append(channel.extensions, unknownIn(node, "fileset"));
}

void Reader::requirePoses() const {
    for (const FileChannel& channel : wall_.channels) {
        const std::string where = fmt::format("region \"{}\"", channel.name);
        if (const char* missing = missingOf(channel, wall_.profile))
            refuse(where, fmt::format("has no {}, which its profile needs", missing));
        if (channel.sizePixels.x == 0)
            throw Error(manifest_.where() + ": " + printable(where) +
                        " has no resolution; say the projector's size in pixels");
    }
}

void Reader::keepFiles() {
    FileOwners owners;
    for (Extension& extension : wall_.extensions) owners.add(extension);
    for (FileChannel& channel : wall_.channels)
        for (Extension& extension : channel.extensions) owners.add(extension);
    if (manifest_.archive == nullptr) return;
    const std::string folder = manifest_.folder();
    for (const std::string& name : manifest_.archive->names()) {
        // As the manifest names it, and as it is named beside one at the root.
        const std::string beside = name.starts_with(folder) ? name.substr(folder.size()) : name;
        if (Extension* owner = owners.of(beside, used_.contains(name)))
            owner->files.emplace_back(beside, manifest_.archive->read(name));
    }
}

void Reader::readDisplay(xml_node display) {
    append(wall_.extensions, unknownIn(display, "display"));
    for (const xml_node buffer : elements(display, "buffer")) {
        where_ = fmt::format("buffer \"{}\"", attribute(buffer, "id"));
        const std::vector<xml_node> regions = elements(buffer, "region");
        if (regions.empty()) refuse(where_, "has no region");
        for (const xml_node region : regions) readRegion(buffer, region);
        append(wall_.channels.back().extensions, unknownIn(buffer, "buffer"));
    }
}

// The filesets in `files`, or beside it.
void Reader::readFiles(xml_node root) {
    for (const xml_node fileset : elements(root, "fileset")) readFileset(fileset);
    for (const xml_node files : elements(root, "files")) {
        append(wall_.extensions, unknownIn(files, "files"));
        for (const xml_node fileset : elements(files, "fileset")) readFileset(fileset);
    }
}

WallFile Reader::read(xml_node root) {
    used_.insert(manifest_.name);
    readHead(root);
    for (const xml_node set : elements(root, "extensionSet"))
        for (const xml_node extension : elements(set, "extension")) readOwnExtension(extension);
    append(wall_.extensions, unknownIn(root, "MPCDI"));
    for (const xml_node display : elements(root, "display")) readDisplay(display);
    if (wall_.channels.empty()) refuse("MPCDI", "has no display with a buffer and a region");
    giveColours();
    readFiles(root);
    for (const xml_node set : elements(root, "extensionSet"))
        append(wall_.extensions, unknownIn(set, "extensionSet"));
    requirePoses();
    keepFiles();
    return std::move(wall_);
}

// Whether an entry was added by the system that packed the archive, beside one of its files.
bool isOfMacOs(std::string_view name) {
    return name.starts_with("__MACOSX/") || name.substr(name.rfind('/') + 1).starts_with("._");
}

// Names of the archive that end so, in the order of the archive; at its root, or in folders of it.
std::vector<std::string> entriesAt(const Archive& archive, bool atRoot, std::string_view ending) {
    std::vector<std::string> found;
    for (const std::string& name : archive.names()) {
        const bool isAtRoot = name.find('/') == std::string::npos;
        if (isAtRoot == atRoot && !isOfMacOs(name) && lowered(name).ends_with(ending))
            found.push_back(name);
    }
    return found;
}

// The error for an archive with several walls, as the right one is not known.
[[noreturn]] void refuseSeveral(const std::string& source, const std::vector<std::string>& names) {
    throw Error(fmt::format("{}: has {} manifests, \"{}\" and \"{}\"; pack each wall by itself",
                            source,
                            names.size(),
                            printable(names[0]),
                            printable(names[1])));
}

// The manifest in a folder of an archive whose root has none; empty where there is none. Throws
// Error where there are several.
std::string manifestInFolders(const Archive& archive, const std::string& source) {
    for (const char* ending : {"/mpcdi.xml", "/mpacs.xml", ".xml"}) {
        const std::vector<std::string> found = entriesAt(archive, false, ending);
        if (found.size() > 1) refuseSeveral(source, found);
        if (!found.empty()) return found.front();
    }
    return "";
}

// The name of the manifest: the standard's, an older one, or that of the only XML file. It may be
// in a folder, where the archive was packed with its folder.
std::string manifestOf(const Archive& archive, const std::string& source) {
    for (const char* name : {"mpcdi.xml", "mpacs.xml"})
        if (const auto found = archive.find(name)) return *found;
    const std::vector<std::string> others = entriesAt(archive, true, ".xml");
    if (others.size() == 1) return others.front();
    std::string inFolders = manifestInFolders(archive, source);
    if (!inFolders.empty()) return inFolders;
    throw Error(
        fmt::format("{}: has no mpcdi.xml, and {} other xml files where one could be "
                    "meant; export it anew",
                    source,
                    others.size()));
}

WallFile readManifest(Bytes bytes, const Manifest& manifest, const ReadOptions& options) {
    const auto refuse = [&](const std::string& what) {
        throw Error(manifest.where() + ": " + what + "; export it anew");
    };
    if (bytes.size() > kMostManifestBytes)
        refuse(fmt::format("has {} bytes, more than the {} that are read of a manifest",
                           bytes.size(),
                           kMostManifestBytes));
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer(bytes.data(), bytes.size(), kParsing);
    if (!result)
        refuse(fmt::format("is no whole XML: {} at byte {}", result.description(), result.offset));
    const xml_node root = document.document_element();
    if (!sameName(root.name(), "MPCDI"))
        refuse(fmt::format("begins with \"{}\" where MPCDI should be", printable(root.name())));
    return Reader(manifest, options).read(root);
}

}  // namespace

const char* missingOf(const FileChannel& channel, Profile profile) {
    const bool isProjector = profile == Profile::Projector;
    if ((isProjector || profile == Profile::View) && !channel.frustum) return "frustum";
    return isProjector && !channel.coordinateFrame ? "coordinateFrame" : nullptr;
}

std::optional<long double> decimalIn(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    long double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool isWhole = error == std::errc() && end == text.data() + text.size();
    // Beyond this a double would be infinite.
    if (!isWhole || !(std::abs(number) <= 1e300L)) return std::nullopt;
    return number;
}

double radiansOf(long double degrees) {
    const long double turn = std::remainder(degrees, 360.0L);
    return static_cast<double>((turn <= -180 ? 180 : turn) * std::numbers::pi_v<long double> / 180);
}

double topOf(long double y, double height) {
    return static_cast<double>(std::max(0.0L, 1 - y - height));
}

bool isMpcdi(Bytes bytes) {
    if (isArchive(bytes)) return true;
    std::string text;  // without the zeros that UTF-16 puts between letters
    for (const std::byte byte : bytes.first(std::min<std::size_t>(bytes.size(), 65536)))
        if (byte != std::byte{0}) text.push_back(static_cast<char>(byte));
    return lowered(text).find("<mpcdi") != std::string::npos;
}

WallFile readMpcdi(Bytes bytes, const std::string& source, const ReadOptions& options) {
    if (!isArchive(bytes)) return readManifest(bytes, {.source = source, .name = ""}, options);
    Archive archive(bytes, source);
    const std::string name = manifestOf(archive, source);
    return readManifest(
        archive.read(name), {.source = source, .name = name, .archive = &archive}, options);
}

}  // namespace aquarama::formats
