// SPDX-License-Identifier: Apache-2.0
// Real photographs of Gray codes (kamino410/procam-calibration, MIT): a projector of 1024 x 768
// columns and rows, a camera of 1280 x 1024.
//
// The measure: a pixel is lit where white is more than kLitCodes brighter than black. It is valid
// where a place was found from its own pictures: never filled in from others. The residual is taken
// in windows of 17 x 17 pixels that are at least 80 % valid: around the homography from camera to
// projector that fits the window best, without the 2 % that lie more than 3 px off; RMS over the
// pixels of all windows, per coordinate. The plain decoder beside it takes each bit from a pattern
// and its inverse, and a pixel as valid where all differ by more than kSureCodes.
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "calibration/scan/decode.h"
#include "calibration/scan/read_picture.h"

namespace aquarama::scan {
namespace {

const std::string kFolder = AQUARAMA_SOURCE_DIR "/../shared/data/graycode_kamino410/capture_0";
int kSureCodes = 5;
using Places = std::vector<glm::vec2>;

Places plain(PictureSource& source) {
    const auto count = source.scan().pictures.size();
    std::vector<Picture> pics;
    for (std::size_t i = 0; i < count; ++i) pics.push_back(source.picture(i));
    const std::size_t n = pics[0].rgb.size() / 3;
    Places out(n);
    for (std::size_t p = 0; p < n; ++p) {
        bool ok = true;
        for (int axis = 0; axis < 2; ++axis) {
            unsigned code = 0;
            for (int k = 0; k < 10; ++k) {
                const auto i = static_cast<std::size_t>(20 * axis + 2 * k);
                const int d = pics[i].rgb[3 * p + 1] - pics[i + 1].rgb[3 * p + 1];
                ok &= std::abs(d) > kSureCodes;
                code = code << 1U | ((d > 0 ? 1U : 0U) ^ (code & 1U));
            }
            ok &= static_cast<int>(code) < (axis == 0 ? 1024 : 768);
            out[p][axis] = static_cast<float>(code) + 0.5F;
        }
        if (!ok) out[p] = glm::vec2(NAN);
    }
    return out;
}

template <std::size_t N>
std::array<double, N> solved(std::array<std::array<double, N + 1>, N> m) {
    for (std::size_t i = 0; i < N; ++i) {
        std::size_t pivot = i;
        for (std::size_t j = i; j < N; ++j)
            if (std::abs(m[j][i]) > std::abs(m[pivot][i])) pivot = j;
        std::swap(m[i], m[pivot]);
        for (std::size_t j = 0; j < N; ++j)
            if (j != i)
                for (std::size_t k = N + 1; k-- > i;) m[j][k] -= m[j][i] / m[i][i] * m[i][k];
    }
    std::array<double, N> x{};
    for (std::size_t i = 0; i < N; ++i) x[i] = m[i][N] / m[i][i];
    return x;
}

struct Sample { glm::dvec2 at, place; };
glm::dvec2 mapped(const std::array<double, 8>& h, glm::dvec2 p) {
    const double w = h[6] * p.x + h[7] * p.y + 1;
    return {(h[0] * p.x + h[1] * p.y + h[2]) / w, (h[3] * p.x + h[4] * p.y + h[5]) / w};
}
std::array<double, 8> homography(const std::vector<Sample>& samples) {
    std::array<std::array<double, 9>, 8> m{};
    for (const Sample& s : samples)
        for (int axis = 0; axis < 2; ++axis) {
            std::array<double, 9> row{};
            const auto o = static_cast<std::size_t>(3 * axis);
            row[o] = s.at.x; row[o + 1] = s.at.y; row[o + 2] = 1;
            row[6] = -s.at.x * s.place[axis]; row[7] = -s.at.y * s.place[axis]; row[8] = s.place[axis];
            for (std::size_t i = 0; i < 8; ++i)
                for (std::size_t j = 0; j < 9; ++j) m[i][j] += row[i] * row[j];
        }
    for (std::size_t i = 0; i < 8; ++i) m[i][i] += 1e-9;
    return solved<8>(m);
}

struct Measure { double valid = 0, residual = 0, windows = 0, outliers = 0; };
Measure measureOf(const Places& places, const std::vector<std::uint8_t>& lit, glm::ivec2 size) {
    Measure m;
    double nl = 0, nv = 0;
    for (std::size_t p = 0; p < places.size(); ++p) { nl += lit[p]; nv += lit[p] && places[p].x == places[p].x; }
    m.valid = nv / nl;
    double sum = 0, count = 0, all = 0;
    for (int y = 8; y + 9 < size.y; y += 17)
        for (int x = 8; x + 9 < size.x; x += 17) {
            std::vector<Sample> s;
            glm::dvec2 mean(0);
            for (int j = -8; j <= 8; ++j)
                for (int i = -8; i <= 8; ++i) {
                    const glm::vec2 pl = places[static_cast<std::size_t>((y + j) * size.x + x + i)];
                    if (pl.x == pl.x) { s.push_back({glm::dvec2(i, j) / 8.0, glm::dvec2(pl)}); }
                }
            if (s.size() < 231) continue;
            std::vector<double> xs, ys;
            for (auto& q : s) { xs.push_back(q.place.x); ys.push_back(q.place.y); }
            std::nth_element(xs.begin(), xs.begin() + long(xs.size() / 2), xs.end());
            std::nth_element(ys.begin(), ys.begin() + long(ys.size() / 2), ys.end());
            mean = {xs[xs.size() / 2], ys[ys.size() / 2]};
            for (auto& q : s) q.place -= mean;
            std::vector<Sample> kept = s;
            std::array<double, 8> h{};
            for (int r = 0; r < 4; ++r) {
                h = homography(kept);
                kept.clear();
                for (auto& q : s) { const glm::dvec2 e = mapped(h, q.at) - q.place; if (std::max(std::abs(e.x), std::abs(e.y)) < (r < 2 ? 6 : 3)) kept.push_back(q); }
                if (kept.size() < 100) break;
            }
            if (kept.size() < 200) continue;
            ++m.windows;
            for (auto& q : kept) { const glm::dvec2 e = mapped(h, q.at) - q.place; sum += e.x * e.x + e.y * e.y; count += 2; }
            all += double(s.size() - kept.size());
        }
    m.residual = std::sqrt(sum / count);
    m.outliers = all / (count / 2);
    return m;
}

TEST(PhotographsTest, MorePixelsAndLessResidualThanAPlainDecoder) {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no " << kFolder;
    config::Rig rig = config::readRig(AQUARAMA_SOURCE_DIR "/config/flat_3.txtpb");
    rig.channels.resize(1);
    rig.channels[0].sizePixels = {1024, 768};
    const auto source = openFolder(kFolder, rig);
    const CameraView view = decode(*source, 0, rig);
    const auto& pics = source->scan().pictures;
    Picture w = source->picture(pics.size() - 2), b = source->picture(pics.size() - 1);
    if (pics.back().pattern.lit) std::swap(w, b);
    for (int lc : {5, 10, 20, 40}) {
        std::vector<std::uint8_t> lit;
        for (std::size_t p = 0; p < w.rgb.size() / 3; ++p) lit.push_back(w.rgb[3 * p + 1] > b.rgb[3 * p + 1] + lc);
        for (int sc : {0, 1, 2, 3, 5, 10}) {
            kSureCodes = sc;
            const Measure m = measureOf(plain(*source), lit, view.sizePixels);
            std::cout << "plain lit>" << lc << " sure>" << sc << ": " << m.valid << " rms " << m.residual << " windows " << m.windows << " out " << m.outliers << "\n";
        }
        const Measure m = measureOf(view.channels[0].place, lit, view.sizePixels);
        std::cout << "ours lit>" << lc << ": " << m.valid << " rms " << m.residual << " windows " << m.windows << " out " << m.outliers << "\n";
    }
    double s = 0, n = 0;
    for (auto v : view.channels[0].sigma) if (v.x == v.x) { s += double{v.x * v.x + v.y * v.y}; n += 2; }
    std::cout << "sigma rms " << std::sqrt(s / n) << " noise " << view.noise << "\n";
    for (const auto& f : view.faults) std::cout << f.cause << ": " << f.advice << "\n";
}

}  // namespace
}  // namespace aquarama::scan
