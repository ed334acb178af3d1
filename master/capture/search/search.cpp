// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/search.h"

#include <algorithm>
#include <exception>

#include <nlopt.hpp>

#include "common/units/digest.h"
#include "common/units/error.h"
#include "master/capture/search/gait_objective.h"

namespace aquarama::search {

namespace {

// Raise it when simulation, objective or parameters change what comes out.
constexpr const char* kSearchVersion = "aquarama search 1";
constexpr double kSwims = 0.01;       // a miss by a tenth of one tolerance
constexpr double kFirstStep = 0.1;    // of the range of each parameter
constexpr double kDoesNotSwim = 1e6;  // the miss of a fish that finds no steady beat

SearchTrial tryAt(const SearchPoint& point, const config::Species& species) {
    SearchTrial trial{.point = point, .miss = kDoesNotSwim};
    try {
        const ForwardFigures gaits = quickFigures(speciesAt(point, species));
        const auto strouhal = [](const GaitFigures& gait) { return gait.swum.strouhal; };
        const auto stride = [](const GaitFigures& gait) { return gait.swum.strideBodyLengths; };
        trial.miss = missOf(gaits);
        trial.leastStrouhal = strouhal(std::ranges::min(gaits, {}, strouhal));
        trial.mostStrouhal = strouhal(std::ranges::max(gaits, {}, strouhal));
        trial.leastStride = stride(std::ranges::min(gaits, {}, stride));
        trial.mostStride = stride(std::ranges::max(gaits, {}, stride));
    } catch (const Error&) {
    }
    return trial;
}

// Makes trials in the optimiser's order; those that the journal holds it only recalls.
class TrialRun {
  public:
    TrialRun(const config::Species& species, SearchJournal& journal, const SearchProgress& progress)
        : species_(species), journal_(journal), progress_(progress) {}

    double missAt(const SearchPoint& point) {
        if (made_ == journal_.trials().size()) journal_.add(tryAt(point, species_));
        const SearchTrial& trial = journal_.trials()[made_++];
        if (trial.point != point)
            throw Error("trial " + std::to_string(made_) +
                        " of the journal is not what this program tries; remove the journal to "
                        "begin anew");
        if (made_ == 1 || trial.miss < best_.miss) best_ = trial;
        progress_(made_, best_);
        return trial.miss;
    }
    [[nodiscard]] const SearchTrial& best() const { return best_; }

  private:
    const config::Species& species_;
    SearchJournal& journal_;
    const SearchProgress& progress_;
    std::size_t made_ = 0;
    SearchTrial best_;
};

}  // namespace

std::string searchName(const std::string& speciesText) {
    return std::string(kSearchVersion) + ' ' + toHex(digestOf(speciesText));
}

SearchTrial searchGaits(const config::Species& species,
                        std::size_t mostTrials,
                        SearchJournal& journal,
                        const SearchProgress& progress) {
    TrialRun run(species, journal, progress);
    SearchPoint point = pointOf(species);
    nlopt::opt optimiser(nlopt::LN_SBPLX, static_cast<unsigned>(point.size()));
    optimiser.set_lower_bounds(0.0);
    optimiser.set_upper_bounds(1.0);
    optimiser.set_initial_step(kFirstStep);
    optimiser.set_maxeval(static_cast<int>(mostTrials));
    optimiser.set_stopval(kSwims);

    // NLopt hands on none but its own exceptions.
    struct Evaluation {
        TrialRun& run;
        std::exception_ptr failure;
    } evaluation{run, {}};
    const auto evaluate = [](const SearchPoint& at, SearchPoint& /*gradient*/, void* data) {
        auto& e = *static_cast<Evaluation*>(data);
        try {
            return e.run.missAt(at);
        } catch (...) {
            e.failure = std::current_exception();
            throw nlopt::forced_stop();
        }
    };
    optimiser.set_min_objective(evaluate, &evaluation);
    try {
        double miss = 0;
        optimiser.optimize(point, miss);
    } catch (const nlopt::forced_stop&) {
        std::rethrow_exception(evaluation.failure);
    } catch (const nlopt::roundoff_limited&) {
        // it can come no closer
    }
    return run.best();
}

}  // namespace aquarama::search
