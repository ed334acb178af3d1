// SPDX-License-Identifier: Apache-2.0
// aquarama_draw_species FOLDER SPECIES.txtpb...: writes FOLDER/species.png, each fish from its
// right, from above, bent to one side, and from the front, all of one length; and
// FOLDER/species_sizes.png, all at one scale.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include <glm/common.hpp>

#include "common/base/picture.h"
#include "tests/common/body/bend.h"
#include "tests/support/portrait.h"

namespace aquarama::test {
namespace {

constexpr int kSamples = 3;  // a pixel each way
constexpr glm::vec3 kWater{0.055F, 0.16F, 0.21F};

Light sheet(glm::vec2 sizePixels) {
    Light light = darkness(glm::ivec2(glm::ceil(sizePixels)) * kSamples);
    std::ranges::fill(light.rgb, kWater);
    return light;
}

Light shrunk(const Light& fine) {
    Light light = darkness(fine.sizePixels / kSamples);
    for (int y = 0; y < light.sizePixels.y * kSamples; ++y)
        for (int x = 0; x < light.sizePixels.x * kSamples; ++x)
            light.at(x / kSamples, y / kSamples) +=
                fine.at(x, y) / static_cast<float>(kSamples * kSamples);
    return light;
}

void save(const Light& fine, const std::string& path) {
    Picture picture = pictureOf(shrunk(fine), 16, 0);  // 8 bits would be dithered: twice the file
    picture.bits = 8;
    for (std::uint16_t& code : picture.rgb) code = static_cast<std::uint16_t>(code >> 8);
    writePng(path, picture);
    std::cout << path << '\n';
}

body::NodalPoints bent(const body::FishBody& body) {
    body::NodalPoints nodes = body.restNodes;
    for (glm::vec3& node : nodes) node = body::bentToTheRight(node, 0.9F);
    return nodes;
}

struct Fish {
    config::Species species;
    body::FishBody body;
    Portrait rest, bend;
    explicit Fish(const config::Species& read)
        : species(read),
          body(body::makeBody(read)),
          rest(read, body, body.restNodes),
          bend(read, body, bent(body)) {}
};

// What stands side by side in a row.
struct Panel {
    const Portrait* portrait;
    View view;
    glm::vec2 corner;
    float scale;  // pixels a body length
};

void draw(Light& paper, const Panel& panel) {
    const glm::vec2 origin = panel.corner - panel.scale * panel.portrait->extent(panel.view).least;
    panel.portrait->draw(
        paper, panel.view, origin * float(kSamples), panel.scale * float(kSamples));
}

void drawViews(const std::vector<Fish>& fish, const std::string& path) {
    constexpr float kScale = 400;
    constexpr float kGap = 30;
    std::vector<Panel> panels;
    glm::vec2 corner(kGap);
    float width = 0;
    for (const Fish& one : fish) {
        float height = 0;
        const auto add = [&](const Portrait& portrait, const View& view, float column) {
            const auto extent = portrait.extent(view);
            height = std::max(height, kScale * (extent.most.y - extent.least.y));
            width = std::max(width, column + kScale * (extent.most.x - extent.least.x));
            panels.push_back({&portrait, view, {column, corner.y}, kScale});
        };
        add(one.rest, kFromTheRight, kGap);
        add(one.rest, kFromAbove, kGap * 2 + kScale);
        add(one.bend, kFromAbove, kGap * 3 + kScale * 2);
        add(one.rest, kFromTheFront, kGap * 4 + kScale * 2.95F);
        corner.y += height + kGap;
    }
    Light paper = sheet({width + kGap, corner.y});
    for (const Panel& panel : panels) draw(paper, panel);
    save(paper, path);
}

void drawSizes(const std::vector<Fish>& fish, const std::string& path) {
    constexpr float kPixelsPerMetre = 760;
    constexpr float kGap = 40;
    constexpr float kWidth = 1500;
    std::vector<Panel> panels;
    glm::vec2 corner(kGap);
    float height = 0;
    for (const Fish& one : fish) {
        const float scale = kPixelsPerMetre * one.body.typicalLengthMetres;
        const auto extent = one.rest.extent(kFromTheRight);
        const glm::vec2 size = scale * (extent.most - extent.least);
        if (corner.x + size.x > kWidth) {
            corner = {kGap, corner.y + height + kGap};
            height = 0;
        }
        panels.push_back({&one.rest, kFromTheRight, corner, scale});
        corner.x += size.x + kGap;
        height = std::max(height, size.y);
    }
    Light paper = sheet({kWidth + kGap, corner.y + height + kGap});
    for (const Panel& panel : panels) draw(paper, panel);
    save(paper, path);
}

}  // namespace
}  // namespace aquarama::test

int main(int count, char** arguments) {
    const std::vector<std::string> words(arguments + 1, arguments + count);
    if (words.size() < 2) {
        std::cerr << "usage: aquarama_draw_species FOLDER SPECIES.txtpb...\n";
        return 2;
    }
    try {
        std::vector<aquarama::test::Fish> fish;
        for (const std::string& path : std::span(words).subspan(1))
            fish.emplace_back(aquarama::config::readSpecies(path));
        aquarama::test::drawViews(fish, words[0] + "/species.png");
        aquarama::test::drawSizes(fish, words[0] + "/species_sizes.png");
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "aquarama_draw_species: " << error.what() << '\n';
        return 1;
    }
}
