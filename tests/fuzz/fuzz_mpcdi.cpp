// SPDX-License-Identifier: Apache-2.0
#include <span>
#include <string>

#include "common/base/log.h"
#include "common/formats/archive.h"
#include "common/formats/mpcdi.h"
#include "common/formats/pfm.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {
namespace {

using Content = std::span<const std::byte>;

bool isSame(const std::optional<formats::ChannelColour>& a,
            const std::optional<formats::ChannelColour>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->mix == b->mix && a->response == b->response && formats::faultOf(*a).empty();
}

// What is read can be written in both versions, and read.
void readAndWrite(Content bytes) {
    formats::WallFile wall;
    try {
        wall = formats::readMpcdi(bytes, "fuzzed");
    } catch (const Error& error) {
        promiseLine(error.what());
        const std::string line = error.what();
        promise(line.starts_with("fuzzed"), "an error names its source");
        return;
    }
    promise(wall.remarks.size() <= formats::kMostRemarks, "remarks are few");
    for (const std::string& remark : wall.remarks) promiseLine(remark);
    for (const int version : {1, 2}) {
        const formats::WallFile again =
            formats::readMpcdi(formats::encodeMpcdi(wall, version), "again");
        promise(again.channels.size() == wall.channels.size(), "no channel is lost");
        for (std::size_t i = 0; i < again.channels.size(); ++i) {
            promise(again.channels[i].name == wall.channels[i].name, "a channel keeps its name");
            promise(again.channels[i].warp.has_value() == wall.channels[i].warp.has_value(),
                    "a channel keeps its warp");
            promise(isSame(again.channels[i].colour, wall.channels[i].colour),
                    "a channel keeps its colour");
        }
    }
}

// Damage within an archive is found by its checksums: so the files of one are damaged before they
// are packed.
void packAndRead(const std::string& manifest, Content floatMap) {
    const Content text = std::as_bytes(std::span(manifest));
    readAndWrite(formats::encodeArchive({{"mpcdi.xml", {text.begin(), text.end()}},
                                         {"a.pfm", {floatMap.begin(), floatMap.end()}}}));
    readAndWrite(formats::encodeArchive({{"hall/mpcdi.xml", {text.begin(), text.end()}},
                                         {"hall/a.pfm", {floatMap.begin(), floatMap.end()}}}));
}

}  // namespace

int fuzzMpcdi(const std::uint8_t* data, std::size_t size) {
    const Content bytes = std::as_bytes(std::span(data, size));
    readAndWrite(bytes);
    if (formats::isArchive(bytes)) return 0;
    if (size > 2 && data[0] == 'P')
        packAndRead(R"(<MPCDI profile="a3"><display><buffer id="b"><region id="a" Xresolution="4"
            Yresolution="2"/></buffer></display><files><fileset region="a"><geometryWarpFile><path>a.pfm
            </path></geometryWarpFile></fileset></files></MPCDI>)",
                    bytes);
    else
        packAndRead({reinterpret_cast<const char*>(data), size},
                    formats::encodePfm({.size = {1, 1}, .texels = {{0.25F, 0.5F, 0}}}));
    return 0;
}

}  // namespace aquarama
