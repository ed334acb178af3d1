// SPDX-License-Identifier: Apache-2.0
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "capture/report/fidelity.h"
#include "tests/support/scad.h"

namespace aquarama::report {
namespace {

const std::vector<Fidelity>& fidelities() {
    static const std::vector<Fidelity> all{
        measureFidelity(test::scad(), test::scadRepertoire(), 5, 10)};
    return all;
}

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        ++found;
    return found;
}

TEST(FidelityCsv, hasALineForEachCommandAndOneForTheWhole) {
    const std::string csv = commandsCsv(fidelities());
    const std::size_t lines = count(csv, "\n");
    EXPECT_EQ(lines, 1 + fidelities().front().comparison.commands.size() + 1);
    EXPECT_EQ(count(csv, ","), 15 * lines);
    EXPECT_EQ(count(csv, "open_loop"), 1U);
}

TEST(FidelityCsv, summariesHaveALineForTheSpeciesAndTwoForEachManoeuvre) {
    const std::string csv = summariesCsv(fidelities());
    std::set<std::string> manoeuvres;  // the run-in is one of them as well
    for (const CommandErrors& errors : fidelities().front().comparison.commands)
        manoeuvres.insert(nameOf(errors.command.manoeuvre));
    EXPECT_EQ(count(csv, "\n"), 1 + 1 + 2 * manoeuvres.size());
    EXPECT_EQ(count(csv, "\nbigeye_scad,all,"), 1U);
    for (const std::string& manoeuvre : manoeuvres)
        for (const char* species : {"bigeye_scad", "all"})
            EXPECT_EQ(count(csv, std::string("\n") + species + "," + manoeuvre + ","), 1U);
    EXPECT_EQ(count(csv, "nan"), 0U);
}

TEST(FidelityCsv, ticksHaveALineForEachAndTheOneBeforeTheirCommand) {
    const std::string csv = ticksCsv(fidelities());
    const Fidelity& fidelity = fidelities().front();
    const std::size_t commands = fidelity.comparison.commands.size();
    const std::size_t lines = count(csv, "\n");
    EXPECT_EQ(lines, 1 + commands + static_cast<std::size_t>(ticksOf(fidelity.script)));
    EXPECT_EQ(count(csv, ","), 13 * lines);
    EXPECT_EQ(count(csv, ",,,,\n"), commands);
    EXPECT_EQ(count(csv, "nan"), 0U);
}

TEST(FidelityCsv, vocabulariesHaveALineForEachNumberOfSegments) {
    const VocabularyErrors seven{.segments = 7, .bytes = 1, .shapeWithin = 0.01, .pathError = 0.1};
    const std::vector<SpeciesVocabularies> vocabularies{{"bigeye_scad", {seven, seven}}};
    const std::string csv = vocabulariesCsv(vocabularies);
    EXPECT_EQ(count(csv, "\nbigeye_scad,7,1,0.01,0.1,0"), 2U);
}

}  // namespace
}  // namespace aquarama::report
