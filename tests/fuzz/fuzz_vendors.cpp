// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <functional>
#include <span>
#include <string>

#include "common/base/log.h"
#include "common/formats/vendors.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

namespace {

using formats::ReadOptions;
using formats::WallFile;

void promiseWhole(const formats::Warp& warp) {
    const auto count =
        static_cast<std::size_t>(warp.size.x) * static_cast<std::size_t>(warp.size.y);
    promise(count > 0 && warp.samples.size() == count, "a warp has the samples that it says");
    for (const glm::vec3& sample : warp.samples)
        promise(std::isnan(sample.x) || std::isfinite(sample.x + sample.y + sample.z),
                "a sample is finite or shows nothing");
}

void promiseWhole(const formats::Mask& mask) {
    const auto count =
        static_cast<std::size_t>(mask.size.x) * static_cast<std::size_t>(mask.size.y);
    promise(count > 0 && mask.codes.size() == count * static_cast<std::size_t>(mask.components),
            "a mask has the codes that it says");
}

void promiseWhole(const WallFile& file) {
    promise(!file.channels.empty(), "a file has a channel");
    promise(file.remarks.size() <= formats::kMostRemarks, "remarks are few");
    for (const std::string& remark : file.remarks) promiseLine(remark);
    for (const formats::FileChannel& channel : file.channels) {
        if (channel.warp) promiseWhole(*channel.warp);
        if (channel.blend) promiseWhole(*channel.blend);
        if (channel.black) promiseWhole(*channel.black);
        if (channel.frustum)
            promise(channel.frustum->left < channel.frustum->right &&
                        channel.frustum->down < channel.frustum->up,
                    "a frustum encloses a picture");
    }
}

void feed(const std::function<WallFile()>& read) {
    try {
        promiseWhole(read());
    } catch (const Error& error) {
        const std::string why = error.what();
        promise(why.starts_with("fuzzed:"), "an error names its source");
        promiseLine(why);
    }
}

}  // namespace

// Every reader whose format it seems to have; a file in eight goes to all of them.
int fuzzVendors(const std::uint8_t* bytes, std::size_t size) {
    const std::span<const std::byte> file = std::as_bytes(std::span(bytes, size));
    const std::string source = "fuzzed";
    const ReadOptions sized{glm::ivec2(32, 18), {}, size % 2 == 1}, plain;
    const auto each = [&](bool is, const auto& read) {
        if (!is && size % 8 != 0) return;
        feed([&] { return read(file, source, sized); });
        feed([&] { return read(file, source, plain); });
    };
    using namespace formats;
    each(isVioso(file), readVioso);
    each(isSciss(file), readSciss);
    each(isScalable(file), readScalable);
    each(isPaulBourke(file), readPaulBourke);
    each(isObj(file), readObjWarp);
    each(isDomeprojection(file),
         [](auto from, const std::string& name, const ReadOptions& options) {
             return readDomeprojection(from, name, options, {name, from});
         });
    each(isSimcad(file), [](auto from, const std::string& name, const ReadOptions& options) {
        return readSimcad(from, name, options);
    });
    return 0;
}

}  // namespace aquarama
