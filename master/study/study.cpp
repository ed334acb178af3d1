// SPDX-License-Identifier: Apache-2.0
#include "master/study/study.h"

#include <atomic>
#include <cmath>
#include <limits>

#include "common/place/noise.h"
#include "common/units/worker_pool.h"
#include "master/study/feeding.h"

namespace aquarama::study {

namespace {

constexpr std::uint64_t kSettlingTicks = 30 * kTicksPerSecond;  // from the start, not watched

struct Task {
    std::size_t scenario, condition;
    std::uint32_t seed;
};

std::vector<Task> tasksOf(const StudyPlan& plan) {
    std::vector<Task> tasks;
    for (std::size_t scenario = 0; scenario < plan.scenarios.size(); ++scenario)
        for (std::size_t condition = 0; condition < kConditions.size(); ++condition)
            for (std::uint32_t seed = 1; seed <= plan.seeds; ++seed)
                tasks.push_back({scenario, condition, seed});
    return tasks;
}

}  // namespace

Figures runOnce(const Scenario& scenario,
                const fish::Adaptation& adaptation,
                std::uint32_t seed,
                double minutes) {
    world::WorldOptions options = scenario.world;
    options.seed = seed;
    options.threads = 1;
    options.adaptation = adaptation;
    world::World world(options);
    for (std::uint64_t tick = 0; tick < kSettlingTicks; ++tick) world.advance();
    Diary diary(world, scenario.halfWidths);
    Feeding feeding(scenario.ticksBetweenPinches, seed);
    const auto ticks = static_cast<std::uint64_t>(minutes * 60 * kTicksPerSecond);
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        feeding.before(world);
        world.advance();
        diary.note(world);
        feeding.after(world, diary.tally().particles);
    }
    return figuresOf(diary, feeding.meanSeconds());
}

std::vector<Sample> runStudy(const StudyPlan& plan, const std::function<void(double)>& done) {
    const std::vector<Task> tasks = tasksOf(plan);
    std::vector<Sample> samples(plan.scenarios.size());
    for (Sample& sample : samples)
        for (auto& seeds : sample) seeds.resize(plan.seeds);
    std::atomic<std::size_t> finished = 0;
    WorkerPool(plan.threads).run(tasks.size(), [&](std::size_t i) {
        const Task& task = tasks[i];
        samples[task.scenario].at(task.condition)[task.seed - 1] =
            runOnce(plan.scenarios[task.scenario],
                    kConditions.at(task.condition).adaptation,
                    task.seed,
                    plan.minutes);
        done(static_cast<double>(++finished) / static_cast<double>(tasks.size()));
    });
    return samples;
}

}  // namespace aquarama::study
