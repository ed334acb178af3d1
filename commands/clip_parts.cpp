// SPDX-License-Identifier: Apache-2.0
// `aquarama replay --clip --part` and the merge of such parts: each machine films some pieces of a
// recorded show, and their clips are joined without encoding again.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands/master_shows.h"
#include "commands/work_parts.h"
#include "common/base/amounts.h"
#include "common/base/byte_stream.h"
#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/config/rig.h"
#include "common/wire/recording.h"
#include "master/supervisor/children.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// "film.mp4.2-of-5.aqpart" has its clip in "film.mp4.2-of-5.mp4" beside it.
fs::path clipOf(const std::string& partFile) {
    return fs::path(partFile).replace_extension(".mp4");
}

// The whole film with its first tick and number of frames. Throws Error where it would begin after
// the end.
supervisor::RunOptions measured(supervisor::RunOptions whole) {
    const wire::Recording recording = wire::readRecording(whole.show.replayPath);
    const Tick last = recording.lastTick();
    const Tick from = firstShown(recording, Tick{whole.show.replayFromTick});
    if (from > last)
        throw Error(whole.show.replayPath + ": ends after " + timeOf(last) +
                    "; begin --at an earlier time");
    const std::uint64_t frames = last.value + 1 - from.value;
    whole.show.replayFromTick = from.value;
    whole.show.frames = std::min(whole.show.frames.value_or(frames), frames);
    return whole;
}

// The recording, the rig with its files, and the options from which the pictures follow.
Digest inputsOf(const supervisor::RunOptions& whole, const config::Rig& rig) {
    ByteWriter content;
    const auto add = [&](const Digest& digest) { content.characters(digest.bytes); };
    add(parts::digestOfFile(whole.show.replayPath));
    add(digestOf(rig.text));
    for (const auto& [name, file] : rig.files) add(digestOf(*file));
    add(digestOf(fmt::format("{} {} {} {} \"{}\" \"{}\"",
                             whole.show.replayFromTick,
                             *whole.show.frames,
                             whole.filmEvery,
                             whole.clipOf,
                             whole.show.quality,
                             whole.show.pattern)));
    return digestOf(content.written());
}

// The film of one part: the frames of its pieces. Nothing where the film has fewer pieces.
std::optional<supervisor::RunOptions> filmOf(parts::Part part,
                                             const supervisor::RunOptions& whole) {
    const std::uint64_t frames = *whole.show.frames;
    const std::uint64_t ofPiece =
        std::uint64_t{parts::kPicturesOfPiece} * static_cast<std::uint64_t>(whole.filmEvery);
    const auto [first, last] = parts::unitsOf(part, (frames + ofPiece - 1) / ofPiece);
    if (first == last) return std::nullopt;
    supervisor::RunOptions film = whole;
    film.clipFromFrame = first * ofPiece;
    film.show.replayFromTick += film.clipFromFrame;
    film.show.frames = std::min(last * ofPiece, frames) - film.clipFromFrame;
    film.clipPath = clipOf(parts::partPath(whole.clipPath, part));
    return film;
}

}  // namespace

int replayPart(const supervisor::RunOptions& options,
               parts::Part part,
               int (*run)(const supervisor::RunOptions&)) {
    if (!options.clipPath.ends_with(".mp4"))
        throw Error("--part makes parts of an MP4 only; name the clip FILE.mp4");
    const config::Rig rig = config::readRig(options.show.rigPath);
    if (options.show.quality.empty() && !rig.quality)
        throw Error(
            "each machine would measure which quality it can draw; choose one by --quality");
    const supervisor::RunOptions whole = measured(options);
    const Digest inputs = inputsOf(whole, rig);
    const auto film = filmOf(part, whole);
    std::vector<std::byte> content;
    if (film) {
        if (const int status = run(*film); status != 0) return status;
        ByteWriter writer;
        writer.unsignedNumber(static_cast<std::uint32_t>(whole.filmEvery));
        writer.characters(parts::digestOfFile(film->clipPath).bytes);
        content = std::move(writer).take();
    }
    writePart(whole.clipPath, part, parts::WorkKind::Clip, inputs, std::move(content));
    return 0;
}

// Hands over to aquarama-compose; returns only by an Error.
void mergeClip(const std::string& out, const WorkInParts& work) {
    std::vector<std::string> arguments{"join", out};
    std::uint32_t every = 1;
    for (const parts::FinishedPart& part : work) {
        if (part.content.empty()) continue;
        Digest digest;
        ByteReader reader(part.content);
        every = reader.unsignedNumber<std::uint32_t>();
        reader.numbers(std::span<std::uint8_t>(digest.bytes));
        requireWhole(reader.ok() && reader.remaining() == 0, part);
        const std::string clip = clipOf(part.path);
        if (parts::digestOfFile(clip) != digest)
            throw Error(clip + ": is not the clip that " + part.path +
                        " tells of; make this part again");
        arguments.push_back(clip);
    }
    arguments.insert(arguments.end(), {"--every", std::to_string(every)});
    supervisor::become({supervisor::siblingProgram("compose"), arguments, "aquarama merge"});
}

}  // namespace aquarama
