// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "calibration/scan/pictures.h"
#include "calibration/scan/read_picture.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

namespace fs = std::filesystem;
using config::ScanPattern;
using Kind = ScanPattern::Kind;

constexpr const char* kManifest = "scan.txtpb";
constexpr std::uintmax_t kMostManifestBytes = std::uintmax_t{16} << 20U;

std::vector<std::string> namesOf(const config::Rig& rig) {
    std::vector<std::string> names;
    names.reserve(rig.channels.size());
    for (const config::Channel& channel : rig.channels) names.push_back(channel.name);
    return names;
}

char lower(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

// Only for letters of ASCII: names may be of any language.
std::string lowered(std::string text) {
    std::ranges::transform(text, text.begin(), lower);
    return text;
}

// Hidden files too are of the system that the folder was on ("._0001.png" of macOS).
bool isPicture(const fs::directory_entry& entry) {
    const std::string ending = lowered(entry.path().extension().string());
    constexpr std::array<const char*, 5> kEndings{".png", ".jpg", ".jpeg", ".tif", ".tiff"};
    return entry.is_regular_file() && !entry.path().filename().string().starts_with('.') &&
           std::ranges::find(kEndings, ending) != kEndings.end();
}

constexpr const char* kDigits = "0123456789";

// A key by which names sort as people count: "2.png" before "10.PNG". Each number is preceded by
// its length without leading zeros; numbers may have any length.
std::string countingKey(const std::string& name) {
    std::string key;
    const std::string text = lowered(name);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_not_of(kDigits, at), text.size());
        const std::size_t first = std::min(text.find_first_not_of('0', at), end);
        if (end > at) key += static_cast<char>('0' + std::min<std::size_t>(end - first, 9));
        key += end > at ? text.substr(first, end - first) : text.substr(at, 1);
        at = std::max(end, at + 1);
    }
    return key;
}

bool comesBefore(const std::string& a, const std::string& b) {
    return std::pair(countingKey(a), a) < std::pair(countingKey(b), b);
}

// In the order in which people count. Throws Error where it is no folder.
std::vector<std::string> picturesIn(const std::string& folder) {
    std::error_code problem;
    std::vector<std::string> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, problem))
        if (isPicture(entry)) files.push_back(entry.path().filename().string());
    if (problem)
        throw Error(folder + " cannot be read as a folder (" + problem.message() +
                    "); check its path and permissions");
    std::ranges::sort(files, comesBefore);
    return files;
}

// The last number of a name; nothing where it has none, or one of too many digits.
std::optional<unsigned long> numberOf(const std::string& name) {
    constexpr std::size_t kMostDigits = 9;
    const std::string stem = fs::path(name).stem().string();
    const std::size_t end = stem.find_last_of(kDigits);
    if (end == std::string::npos) return std::nullopt;
    const std::size_t begin = stem.find_last_not_of(kDigits, end) + 1;  // 0 where it is npos
    if (end - begin >= kMostDigits) return std::nullopt;
    return std::stoul(stem.substr(begin, end + 1 - begin));
}

// The gap in the numbers of the names; empty where there is none.
std::string gapIn(const std::vector<std::string>& files) {
    for (std::size_t i = 1; i < files.size(); ++i) {
        const auto before = numberOf(files[i - 1]), here = numberOf(files[i]);
        if (before && here && *here > *before + 1)
            return "; none lies between " + files[i - 1] + " and " + files[i];
    }
    return "";
}

// The subfolder that has the pictures, where the folder itself has none.
std::string hintAt(const std::string& folder) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.is_directory() && !picturesIn(entry.path().string()).empty())
            return "; its folder " + entry.path().filename().string() + " has some: give that";
    return "";
}

// All bits of one axis, the coarsest first, each before its inverse.
void addGray(std::vector<ScanPattern>& patterns, Kind kind, int pixels) {
    const ScanPattern gray{.kind = kind, .finestPixels = 1, .lit = 1, .tagged = false};
    for (int bit = 0; bit < wall::scanGrayBits(pixels, 1); ++bit)
        for (const bool inverse : {false, true}) {
            patterns.push_back(gray);
            patterns.back().step = static_cast<std::uint8_t>(bit);
            patterns.back().inverse = inverse;
        }
}

// The patterns that OpenCV's GrayCodePattern and similar programs show with one projector, with
// white and black at the end, here in this order.
std::vector<ScanPattern> openCvSequence(glm::ivec2 size) {
    std::vector<ScanPattern> patterns;
    addGray(patterns, Kind::GrayColumns, size.x);
    addGray(patterns, Kind::GrayRows, size.y);
    patterns.push_back({.lit = 1, .tagged = false});
    patterns.push_back({.light = glm::vec3(0), .lit = 0, .tagged = false});
    return patterns;
}

// The mean light of a picture's codes, at any scale.
double brightnessOf(const std::string& path) {
    const Picture picture = readPicture(path);
    double sum = 0;
    for (const std::uint16_t code : picture.rgb) sum += code;
    return sum;
}

// White and black come first or last, in any order. Of these two pairs they are the one whose light
// differs more, as any stripes light half of the picture.
void placeWhite(std::vector<ScanPattern>& patterns,
                const std::string& folder,
                const std::vector<std::string>& files) {
    const auto light = [&](std::size_t i) { return brightnessOf(folder + "/" + files[i]); };
    const std::size_t end = files.size();
    const std::array<double, 2> first{light(0), light(1)}, last{light(end - 2), light(end - 1)};
    const bool isFirst = std::abs(first[0] - first[1]) > std::abs(last[0] - last[1]);
    const auto& pair = isFirst ? first : last;
    if (pair[1] > pair[0]) std::swap(patterns.end()[-1], patterns.end()[-2]);
    if (isFirst) std::rotate(patterns.begin(), patterns.end() - 2, patterns.end());
}

// The sequence with this number of pictures. Throws Error where none has it.
std::vector<ScanPattern> patternsOf(const std::string& folder,
                                    const std::vector<std::string>& files,
                                    const config::Rig& rig) {
    std::vector<ScanPattern> patterns = sequenceOf(rig);
    if (files.size() == patterns.size()) return patterns;
    std::string orders = std::to_string(patterns.size()) + " (of a scan of this rig)";
    if (rig.channels.size() == 1) {
        patterns = openCvSequence(rig.channels[0].sizePixels);
        orders += " or " + std::to_string(patterns.size()) + " (Gray codes with inverses)";
    }
    if (files.size() != patterns.size() || rig.channels.size() != 1)
        throw Error(folder + " has " + std::to_string(files.size()) + " pictures and no " +
                    kManifest + "; there must be " + orders + ", or a " + kManifest +
                    (files.empty() ? hintAt(folder) : gapIn(files)));
    placeWhite(patterns, folder, files);
    return patterns;
}

// By the manifest where there is one, else by the pictures' number.
config::Scan scanOf(const std::string& folder, const config::Rig& rig) {
    const fs::path manifest = fs::path(folder) / kManifest;
    if (fs::exists(manifest)) {
        const std::vector<std::byte> bytes = readWhole(manifest, kMostManifestBytes);
        const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return config::parseScan(text, manifest.string(), namesOf(rig));
    }
    const std::vector<std::string> files = picturesIn(folder);
    const std::vector<ScanPattern> patterns = patternsOf(folder, files, rig);
    config::Scan scan{.rig = rig.name, .cameras = {{}}, .pictures = {}};
    for (std::size_t i = 0; i < files.size(); ++i)
        scan.pictures.push_back({.file = files[i],
                                 .exposureSeconds = wall::scanExposure(patterns[i]),
                                 .pattern = patterns[i]});
    return scan;
}

// The name of a file of the folder that is equal but for the case of letters, which other systems
// change; empty where there is none.
std::string nameThere(const std::string& folder, const std::string& name) {
    if (fs::is_regular_file(fs::path(folder) / name)) return name;
    for (const std::string& there : picturesIn(folder))
        if (lowered(there) == lowered(name)) return there;
    return "";
}

// Throws Error where a picture is missing.
void findFiles(const std::string& folder, config::Scan& scan) {
    std::vector<std::string> missing;
    for (config::ScanPicture& picture : scan.pictures) {
        const std::string there = nameThere(folder, picture.file);
        if (there.empty()) missing.push_back(picture.file);
        picture.file = there;
    }
    if (missing.empty()) return;
    const std::string more =
        missing.size() == 1 ? "" : " and " + std::to_string(missing.size() - 1) + " more";
    throw Error(folder + " has no " + missing.front() + more +
                ", which its scan names; copy all of the scan's pictures");
}

std::string sizeText(glm::ivec2 size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

// Reads each picture when it is asked for; keeps none.
class FolderSource final : public PictureSource {
  public:
    FolderSource(std::string folder, config::Scan scan)
        : folder_{std::move(folder)}, scan_{std::move(scan)}, sizes_(scan_.cameras.size()) {}
    [[nodiscard]] const config::Scan& scan() const override { return scan_; }
    [[nodiscard]] Picture picture(std::size_t index) override {
        const config::ScanPicture& wanted = scan_.pictures.at(index);
        const std::string path = folder_ + "/" + wanted.file;
        Picture picture = readPicture(path);
        std::optional<glm::ivec2>& size = sizes_.at(wanted.camera);
        if (size && *size != picture.sizePixels)
            throw Error(path + " has " + sizeText(picture.sizePixels) + " pixels, others have " +
                        sizeText(*size) +
                        "; all pictures of a camera must have one size: take them with one "
                        "setting, and move what is none of them out of the folder");
        size = picture.sizePixels;
        return picture;
    }

  private:
    std::string folder_;
    config::Scan scan_;
    std::vector<std::optional<glm::ivec2>> sizes_;  // of each camera's pictures, once one was read
};

std::string lossless(std::size_t index) {
    const std::string number = std::to_string(index + 1);
    return std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number + ".png";
}

}  // namespace

std::unique_ptr<PictureSource> openFolder(const std::string& folder, const config::Rig& rig) {
    config::Scan scan = scanOf(folder, rig);
    findFiles(folder, scan);
    return std::make_unique<FolderSource>(folder, std::move(scan));
}

void writeFolder(PictureSource& source, const std::string& folder, const config::Rig& rig) {
    config::Scan scan = source.scan();
    for (std::size_t i = 0; i < scan.pictures.size(); ++i) {
        scan.pictures[i].file = lossless(i);
        writePng(folder + "/" + scan.pictures[i].file, source.picture(i));
    }
    const std::string text = config::textOf(scan, namesOf(rig));
    writeWhole(fs::path(folder) / kManifest, std::as_bytes(std::span(text)));
}

}  // namespace aquarama::scan
