// SPDX-License-Identifier: Apache-2.0
#include "common/wire/kept_drawings.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include <google/protobuf/text_format.h>

#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/config/rules.h"
#include "common/config/text_file.h"
#include "common/config/text_reader.h"
#include "common/wire/messages.h"

namespace aquarama::wire {

namespace {

constexpr std::uint32_t kVersion = 1;

}  // namespace

v1::KeptDrawings readKeptDrawings(const std::filesystem::path& path) {
    v1::KeptDrawings list;
    config::TextReader file(config::readTextFile(path.string()), path.string(), list);
    file.check();
    return list;
}

void keepDrawings(const std::filesystem::path& path, v1::KeptDrawings list) {
    list.set_version(kVersion);
    std::string text;
    google::protobuf::TextFormat::PrintToString(list, &text);
    text = "# The drawings of visitors that wait or swim.\n" + text;
    writePrivate(path, std::as_bytes(std::span{text}));
}

std::optional<v1::KeptDrawings> keptDrawingsIn(std::span<const std::byte> blob) {
    v1::KeptDrawings list;
    const auto hasSkin = [](const v1::KeptDrawing& one) {
        return one.picture().size() == sizeof(Digest);
    };
    if (blob.size() > kMostSmallPacketBytes ||
        !list.ParseFromArray(blob.data(), static_cast<int>(blob.size())) ||
        !config::keepsRules(list) || !std::ranges::all_of(list.drawings(), hasSkin))
        return std::nullopt;
    return list;
}

}  // namespace aquarama::wire
