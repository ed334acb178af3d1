// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/capture_repertoire.h"

#include <array>
#include <future>
#include <mutex>
#include <numeric>

#include "master/capture/compile/compile_segment.h"

namespace aquarama {

namespace {

constexpr std::array kSimulated{Action::ForwardSlow,
                                Action::ForwardMedium,
                                Action::ForwardFast,
                                Action::TurnLeftGradual,
                                Action::TurnLeftSharp};

// The mean of the actions' progress, told under a lock.
class SharedProgress {
  public:
    explicit SharedProgress(const Progress& progress) : progress_(progress) {}
    void tell(std::size_t action, double share) {
        const std::lock_guard lock(mutex_);
        shares_.at(action) = share;
        progress_(std::accumulate(shares_.begin(), shares_.end(), 0.0) / kSimulated.size());
    }

  private:
    const Progress& progress_;
    std::mutex mutex_;
    std::array<double, kSimulated.size()> shares_{};
};

}  // namespace

Repertoire captureRepertoire(const Species& species, const Progress& progress) {
    SharedProgress shared(progress);
    std::array<std::future<Recording>, kSimulated.size()> recordings;
    for (std::size_t i = 0; i < kSimulated.size(); ++i)
        recordings.at(i) = std::async(std::launch::async, [&shared, &species, i] {
            return record(species, kSimulated.at(i), [&](double share) { shared.tell(i, share); });
        });

    const FishBody body = makeBody(species);
    Repertoire repertoire;
    repertoire.species = species.name;
    repertoire.recordedLengthMetres = body.typicalLengthMetres;
    const auto segment = [&](Action action) -> ActionSegment& {
        return repertoire.segments.at(static_cast<std::size_t>(action));
    };
    segment(Action::ForwardSlow) = compileForward(body, recordings[0].get());
    segment(Action::ForwardMedium) = compileForward(body, recordings[1].get());
    segment(Action::ForwardFast) = compileForward(body, recordings[2].get());
    const Recording gradual = recordings[3].get();
    segment(Action::TurnLeftGradual) = compileLeftTurn(body, gradual);
    segment(Action::TurnRightGradual) = compileRightTurn(body, gradual);
    const Recording sharp = recordings[4].get();
    segment(Action::TurnLeftSharp) = compileLeftTurn(body, sharp);
    segment(Action::TurnRightSharp) = compileRightTurn(body, sharp);
    addGlide(repertoire);
    return repertoire;
}

}  // namespace aquarama
