// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/looks.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "common/base/characters.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/config/scene.h"

namespace aquarama::conductor {
namespace {

using Phase = ShowControl::Phase;

constexpr net::Duration kRepeat = std::chrono::seconds(1);
// To build a look; software OpenGL on a busy machine takes some ten seconds.
constexpr net::Duration kMostPreparing = std::chrono::seconds(120);

template <class Result>
bool isReady(const std::future<Result>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void nameRigFiles(v1::Look& look, const std::map<std::string, Digest>& files) {
    look.clear_rig_files();
    for (const auto& [name, digest] : files) {
        v1::RigFile& file = *look.add_rig_files();
        file.set_name(name);
        file.set_digest(wire::bytesOf(digest));
    }
}

void chooseQuality(v1::Look& look, const std::optional<config::QualityTier>& tier) {
    if (tier) look.set_quality(static_cast<std::uint32_t>(*tier));
}

}  // namespace

Blobs blobsOf(const wire::AssetBundle& assets) {
    Blobs blobs;
    for (const wire::SpeciesAssets& species : assets.cast) {
        const auto text = std::as_bytes(std::span{species.text});
        blobs.emplace(digestOf(text),
                      std::make_shared<const net::ByteVector>(text.begin(), text.end()));
        blobs.emplace(digestOf(species.repertoire),
                      std::make_shared<const net::ByteVector>(species.repertoire));
    }
    return blobs;
}

v1::Look lookOf(const wire::AssetBundle& assets, std::span<const motion::FishTraits> school) {
    v1::Look look;
    look.set_scene_text(assets.scene);
    look.set_seed(assets.seed);
    for (const motion::FishTraits& fish : school) {
        look.add_fish_ids(fish.id);
        look.add_length_millimetres(fish.lengthMillimetres);
    }
    for (const wire::SpeciesAssets& species : assets.cast) {
        v1::SpeciesBlobs& member = *look.add_cast();
        member.set_species(wire::bytesOf(digestOf(species.text)));
        member.set_repertoire(wire::bytesOf(digestOf(species.repertoire)));
        member.set_fish(species.fish);
    }
    return look;
}

Looks::Looks(LookSources sources,
             v1::Welcome welcome,
             const std::map<std::string, net::Blob>& rigFiles,
             v1::Look look,
             Blobs blobs,
             ShowControl& control,
             Roster& roster,
             const Sender& sender)
    : sources_{std::move(sources)},
      control_{control},
      roster_{roster},
      sender_{sender},
      welcome_{std::move(welcome)},
      blobs_{std::move(blobs)} {
    for (const auto& [name, content] : rigFiles) {
        const Digest digest = digestOf(std::span{*content});
        rigFiles_.emplace(name, digest);
        blobs_.emplace(digest, content);
    }
    nameRigFiles(look, rigFiles_);
    look.set_number(control_.look());
    look.set_world(control_.hasWorld());
    chooseQuality(look, wire::tierIn(control_.wanted()));
    *welcome_.mutable_look() = std::move(look);
    tellShown();
}

void Looks::tellShown() {
    calibration_ = wire::calibrationOf(welcome_.rig_text(), shown());
    v1::Envelope message;
    *message.mutable_welcome() = welcome_;
    welcomePacket_ = sender_.packetOf(std::move(message));
    const std::filesystem::path scene = control_.wanted().scene();
    sceneName_ = legible(scene.stem().string(), wire::kMostNameBytes);
    ownColour_ = config::parseScene(shown().scene_text(), sceneName_).water.colourReturned;
}

double Looks::colourReturned() const {
    const v1::WantedShow& wanted = control_.wanted();
    return wanted.has_colour_returned() ? wanted.colour_returned() : ownColour_;
}

config::QualityTier Looks::quality() const {
    return shown().has_quality() ? *config::tierAt(shown().quality()) : roster_.finestTier();
}

net::Blob Looks::blob(const Digest& digest) const {
    const auto blob = blobs_.find(digest);
    return blob == blobs_.end() ? nullptr : blob->second;
}

void Looks::step(net::Moment now) {
    if (control_.phase() == Phase::Steady) watchRigFiles(now);
    if (control_.phase() == Phase::Making) makeNextWorld();
    if (control_.phase() == Phase::Preparing) prepareNodes(now);
}

void Looks::watchRigFiles(net::Moment now) {
    constexpr net::Duration kBetween = std::chrono::seconds(1);
    if (!sources_.changedRig) return;
    if (!rereading_.valid() && now - lastReread_ > kBetween) {
        lastReread_ = now;
        rereading_ = std::async(std::launch::async, [&changed = sources_.changedRig] {
            ReadFiles files;
            if (const auto rig = changed())
                for (const auto& [name, content] : rig->files)
                    files.emplace(name, std::pair{digestOf(std::span{*content}), content});
            return files;
        });
    }
    if (!isReady(rereading_)) return;
    try {
        auto files = rereading_.get();
        RigFiles next;
        for (const auto& [name, file] : files) next.emplace(name, file.first);
        if (next.empty() || next == rigFiles_ || !control_.renew()) return;
        nextRigFiles_ = std::move(next);
        for (auto& [name, file] : files) blobs_.try_emplace(file.first, std::move(file.second));
        logInfo("the files of the wall have changed; nodes build them");
    } catch (const Error& problem) {
        logWarning("the wall stays as it is: {}", problem.what());
    }
}

void Looks::forgetRigFiles(const RigFiles& old, const RigFiles& kept) {
    for (const auto& [name, digest] : old)
        if (std::ranges::none_of(
                kept, [&gone = digest](const auto& file) { return file.second == gone; }))
            blobs_.erase(digest);
}

void Looks::makeNextWorld() {
    if (!making_.valid())
        making_ = std::async(std::launch::async, [this, scene = control_.next().scene()] {
            return sources_.makeWorld(scene);
        });
    if (!isReady(making_)) return;
    try {
        made_ = making_.get();
        blobs_.merge(blobsOf(made_->assets));
        control_.made();
    } catch (const Error& problem) {
        logWarning("the scene stays: {}", problem.what());
        control_.fail(problem.what());
    }
}

void Looks::announceNext(net::Moment now) {
    next_ = made_ ? lookOf(made_->assets, made_->school) : shown();
    nameRigFiles(*next_, nextRigFiles_.value_or(rigFiles_));
    next_->set_number(control_.nextLook());
    next_->set_world(control_.nextHasWorld());
    const auto chosen = wire::tierIn(control_.next());
    chooseQuality(*next_, chosen ? chosen : roster_.measuredTier());
    v1::Envelope message;
    *message.mutable_prepare()->mutable_look() = *next_;
    prepare_ = sender_.packetOf(std::move(message));
    preparingSince_ = now;
    lastPrepare_ = {};
}

// Nodes that take part are waited for; one that comes later builds the look before it is shown, or
// joins again after that.
void Looks::prepareNodes(net::Moment now) {
    if (!next_) announceNext(now);
    const bool isDue = now - lastPrepare_ > kRepeat;
    if (isDue) lastPrepare_ = now;
    const auto lacksIt = [&](const NodeSeat& seat) {
        return seat.prepared && seat.builtLook != next_->number();
    };
    if (isDue)
        for (const NodeSeat& seat : roster_.seats())
            if (lacksIt(seat)) sender_.send(seat.peer, prepare_);
    const std::string missing = roster_.listed(lacksIt);
    if (missing.empty()) return control_.prepared();
    control_.setWaitingFor("prepared by all nodes but " + missing);
    if (now - preparingSince_ > kMostPreparing) giveUpNext(missing);
}

void Looks::giveUpNext(const std::string& missing) {
    logWarning("the wall stays as it is: {} did not build the next look in time", missing);
    if (nextRigFiles_) forgetRigFiles(*nextRigFiles_, rigFiles_);
    nextRigFiles_.reset();
    control_.fail("not prepared within two minutes by " + missing + "; see its log");
    next_.reset();
    made_.reset();
}

std::optional<NextWorld> Looks::switchToNext() {
    assert(next_ && control_.phase() == Phase::Switching);
    if (nextRigFiles_) {
        forgetRigFiles(rigFiles_, *nextRigFiles_);
        rigFiles_ = std::move(*nextRigFiles_);
        nextRigFiles_.reset();
    }
    *welcome_.mutable_look() = *std::move(next_);
    next_.reset();
    control_.switched();
    tellShown();
    logInfo("showing look {}: scene {}, quality {}",
            control_.look(),
            control_.wanted().scene(),
            config::nameOf(quality()));
    return std::exchange(made_, std::nullopt);
}

ShowKeeper::ShowKeeper(std::filesystem::path path, v1::WantedShow kept)
    : path_{std::move(path)}, newest_{kept}, begun_{kept}, tried_{std::move(kept)} {}

ShowKeeper::~ShowKeeper() {
    if (writing_.valid()) writing_.wait();
}

void ShowKeeper::finish(const v1::WantedShow& show) {
    if (writing_.valid()) writing_.wait();
    keep(show, net::monotonicNow());
    if (writing_.valid()) writing_.wait();
}

void ShowKeeper::keep(const v1::WantedShow& show, net::Moment now) {
    if (path_.empty()) return;
    newest_ = show;
    if (isReady(writing_)) {
        if (const std::string problem = writing_.get(); !problem.empty())
            warnOnceOf(path_, problem, "what was set is lost with the next start");
        tried_ = begun_;
    }
    if (writing_.valid() || wire::areSame(show, begun_)) return;
    begun_ = show;
    begunAt_ = now;
    writing_ = std::async(std::launch::async, [path = path_, show]() -> std::string {
        try {
            wire::keepShow(path, show);
            return {};
        } catch (const Error& problem) {
            return problem.what();
        }
    });
}

std::optional<net::Moment> ShowKeeper::writesSince(const v1::WantedShow& change) const {
    const auto has = [&](const v1::WantedShow& show) {
        v1::WantedShow changed = show;
        wire::apply(changed, change);
        return wire::areSame(changed, show);
    };
    const bool stays = has(tried_) && has(begun_);
    if (!has(newest_) || stays) return std::nullopt;
    return begunAt_;
}

}  // namespace aquarama::conductor
