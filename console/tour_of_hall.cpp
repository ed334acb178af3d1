// SPDX-License-Identifier: Apache-2.0
#include "console/tour_of_hall.h"

#include <nlohmann/json.hpp>

#include "console/run_aquarama.h"

namespace aquarama::console {

browser::Tour tourIn(const std::string& text) {
    using nlohmann::json;
    browser::Tour tour;
    try {
        const json said = json::parse(text);
        tour.set_seconds(said.at("seconds").get<double>());
        for (const json& from : said.at("steps")) {
            browser::TourStep& step = *tour.add_steps();
            step.set_name(from.at("name").get<std::string>());
            step.set_state(from.at("state").get<std::string>());
            step.set_found(from.at("found").get<std::string>());
            step.set_todo(from.at("todo").get<std::string>());
            step.set_seconds(from.at("seconds").get<double>());
        }
    } catch (const json::exception&) {
        tour.Clear();
        tour.set_problem("the steps cannot be read");
    }
    return tour;
}

// The exit status is 1 while something is to be done.
browser::Tour tourOf(const std::string& rigFile) {
    const Said said = runAquarama({"tour", rigFile, "--json"}, true);
    for (const std::string& line : linesOf(said.text))
        if (line.starts_with('{')) return tourIn(line);
    browser::Tour tour;
    tour.set_problem(lastLineOf(said, "aquarama tour does not answer"));
    return tour;
}

std::string confirmStep(const std::string& rigFile,
                        const std::string& step,
                        const std::string& found) {
    const Said said = runAquarama({"tour", rigFile, "--confirm", step, "--found=" + found}, true);
    return said.status == 0 ? std::string() : lastLineOf(said, "aquarama tour does not answer");
}

}  // namespace aquarama::console
