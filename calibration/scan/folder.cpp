// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>

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

bool isPicture(const fs::directory_entry& entry) {
    std::string ending = entry.path().extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    constexpr std::array<const char*, 5> kEndings{".png", ".jpg", ".jpeg", ".tif", ".tiff"};
    return entry.is_regular_file() && std::ranges::find(kEndings, ending) != kEndings.end();
}

std::vector<std::string> picturesIn(const std::string& folder) {
    std::error_code problem;
    std::vector<std::string> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, problem))
        if (isPicture(entry)) files.push_back(entry.path().filename().string());
    if (problem) throw Error(folder + " cannot be read as a folder: " + problem.message());
    std::ranges::sort(files);
    return files;
}

void addGray(std::vector<ScanPattern>& patterns, Kind kind, int pixels) {
    const ScanPattern gray{.kind = kind, .finestPixels = 1, .lit = 1, .tagged = false};
    for (int bit = 0; bit < wall::scanGrayBits(pixels, 1); ++bit)
        for (const bool inverse : {false, true}) {
            patterns.push_back(gray);
            patterns.back().step = static_cast<std::uint8_t>(bit);
            patterns.back().inverse = inverse;
        }
}

// What OpenCV's GrayCodePattern and programs after it show with one projector; white and black at
// the end, here in this order.
std::vector<ScanPattern> openCvSequence(glm::ivec2 size) {
    std::vector<ScanPattern> patterns;
    addGray(patterns, Kind::GrayColumns, size.x);
    addGray(patterns, Kind::GrayRows, size.y);
    patterns.push_back({.lit = 1, .tagged = false});
    patterns.push_back({.light = glm::vec3(0), .lit = 0, .tagged = false});
    return patterns;
}

double brightnessOf(const std::string& path) {
    const Picture picture = readPicture(path);
    double sum = 0;
    for (const std::uint16_t code : picture.rgb) sum += code;
    return sum;
}

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
                    kManifest + "; there must be " + orders + ", or a " + kManifest);
    const auto last = [&](std::size_t back) { return folder + "/" + files[files.size() - back]; };
    if (brightnessOf(last(1)) > brightnessOf(last(2)))
        std::swap(patterns.end()[-1], patterns.end()[-2]);
    return patterns;
}

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

void checkFiles(const std::string& folder, const config::Scan& scan) {
    for (const config::ScanPicture& picture : scan.pictures)
        if (!fs::is_regular_file(fs::path(folder) / picture.file))
            throw Error(folder + " has no " + picture.file +
                        ", which its scan names; copy all of the scan's pictures");
}

std::string sizeText(glm::ivec2 size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

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
                        sizeText(*size) + "; all pictures of a camera must have one size");
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
    checkFiles(folder, scan);
    return std::make_unique<FolderSource>(folder, std::move(scan));
}

void writeFolder(PictureSource& source, const std::string& folder, const config::Rig& rig) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) throw Error(folder + " cannot be made: " + problem.message());
    config::Scan scan = source.scan();
    for (std::size_t i = 0; i < scan.pictures.size(); ++i) {
        scan.pictures[i].file = lossless(i);
        writePng(folder + "/" + scan.pictures[i].file, source.picture(i));
    }
    const std::string text = config::textOf(scan, namesOf(rig));
    writeWhole(fs::path(folder) / kManifest, std::as_bytes(std::span(text)));
}

}  // namespace aquarama::scan
