// SPDX-License-Identifier: Apache-2.0
#include "master/capture/fidelity/fidelity_report.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/scad.h"

namespace aquarama::fidelity {
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

TEST(FidelityReport, csvHasALineForEachCommandAndOneForTheWhole) {
    const std::string csv = fidelityCsv(fidelities());
    const std::size_t lines = count(csv, "\n");
    EXPECT_EQ(lines, 1 + fidelities().front().comparison.commands.size() + 1);
    EXPECT_EQ(count(csv, ","), 15 * lines);
    EXPECT_EQ(count(csv, "open_loop"), 1U);
}

TEST(FidelityReport, pageHoldsItsPicturesAndTables) {
    const VocabularyErrors seven{.segments = 7, .bytes = 1, .shapeWithin = 0.01, .pathError = 0.1};
    const std::vector<SpeciesVocabularies> vocabularies{{"bigeye_scad", {seven}}};
    const std::string page = fidelityPage(fidelities(), vocabularies, 5);
    EXPECT_EQ(count(page, "<svg"), 3U);
    EXPECT_EQ(count(page, "</svg>"), 3U);
    EXPECT_EQ(count(page, "<h2>bigeye_scad</h2>"), 1U);
    EXPECT_EQ(count(page, "src="), 0U) << "a self-contained page fetches nothing";
    EXPECT_EQ(count(page, "nan"), 0U);
}

TEST(FidelityReport, tablesInMarkdownHaveARowForEachSpeciesAndManoeuvre) {
    const std::string tables = fidelityMarkdown(fidelities());
    EXPECT_EQ(count(tables, "| bigeye_scad |"), 1U);
    for (const ScriptCommand& command : fidelities().front().script)
        EXPECT_EQ(count(tables, std::string("| ") + nameOf(command.manoeuvre) + " |"), 1U);
}

}  // namespace
}  // namespace aquarama::fidelity
