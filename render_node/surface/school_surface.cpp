// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/school_surface.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <future>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include "common/body/side_view.h"
#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/surface/drawn_skins.h"
#include "render_node/surface/fish_tables.h"

namespace aquarama::surface {

namespace {

// The include that a species' own skin shader replaces.
constexpr const char* kPlain = "skin_plain.glsl";

// The skin shader of a species, or the plain one.
std::string skinShaderOf(const body::FishSkin& skin) {
    std::string file = "skin_" + skin.species + ".glsl";
    const auto files = gl::shaderNames();
    return std::ranges::find(files, file) == files.end() ? std::string(kPlain) : file;
}

}  // namespace

gl::ProgramHandle skinProgram(const std::vector<std::string>& shaderFiles,
                              const body::FishSkin& skin,
                              gl::Replacements replacements) {
    replacements.push_back({kPlain, skinShaderOf(skin)});
    gl::ProgramHandle program = gl::makeProgram(shaderFiles, replacements);
    const std::array<glm::vec3, 3> colours{skin.back, skin.flank, skin.belly};
    // A uniform that this skin shader does not read has location -1, which OpenGL ignores.
    const auto at = [&](const char* name) { return glGetUniformLocation(program.name(), name); };
    const body::FishFace& face = skin.face;
    const glm::vec4 gape{face.front, face.corner};
    glProgramUniform3fv(program.name(), at("eyeOfSpecies"), 1, &face.eye.x);
    glProgramUniform4fv(program.name(), at("gapeOfSpecies"), 1, &gape.x);
    glProgramUniform2f(program.name(), at("lipsOfSpecies"), face.lip, face.teeth);
    glProgramUniform2fv(program.name(), at("gillOfSpecies"), 1, &face.gill.x);
    glProgramUniform3fv(program.name(), at("groundColours"), 3, &colours[0].x);
    return program;
}

std::shared_ptr<const SkinPrograms> makeSkinPrograms(gl::Replacements replacements) {
    return std::make_shared<const SkinPrograms>(
        SkinPrograms{gl::makeProgram({"fish.comp"}), std::move(replacements)});
}

namespace {

gl::Replacements replacementsFor(Worn worn, gl::Replacements replacements) {
    if (worn == Worn::Drawing) {
        replacements.push_back({"own_skin.glsl", "drawn_skin.glsl"});
    }
    return replacements;
}

// From (-s, y) to a place of the texture, whose first row is the top.
glm::vec4 sideOf(const body::FishBody& body) {
    const body::SideView view = body::sideViewOf(body);
    const glm::vec2 size = view.most - view.least;
    return {1 / size.x, -1 / size.y, -view.least.x / size.x, view.most.y / size.y};
}

}  // namespace

SkinShader::SkinShader(const SchoolSpecies& species, Worn worn, const gl::Replacements& tier)
    : SkinShader{species.skin, replacementsFor(worn, tier)} {
    if (worn == Worn::Own) return;
    const glm::vec4 side = sideOf(species.body);
    for (const gl::ProgramHandle* program :
         {&nearBody, &farBody, &fins, &fewBody, &fewFins, &point})
        glProgramUniform4fv(
            program->name(), glGetUniformLocation(program->name(), "sideOfSpecies"), 1, &side.x);
}

SkinShader::SkinShader(const body::FishSkin& skin, const gl::Replacements& replacements)
    : nearBody{skinProgram({"fish.vert", "fish_body.frag"}, skin, replacements)},
      farBody{skinProgram({"fish.vert", "fish_far.frag"}, skin, replacements)},
      fins{skinProgram({"fish.vert", "fish_fin.frag"}, skin, replacements)},
      fewBody{skinProgram({"fish_few.vert", "fish_far.frag"}, skin, replacements)},
      fewFins{skinProgram({"fish_few.vert", "fish_fin.frag"}, skin, replacements)},
      point{skinProgram({"fish_point.vert", "fish_far.frag"}, skin, replacements)} {}

namespace {

// A vertex of a surface: three floats and a packed normal (fish.comp).
constexpr std::size_t kBytesPerVertex = 16;

// 0, 1, 2 ..., at least one number. As an instanced attribute they give a shader its place in the
// school, since gl_InstanceID does not count from the first instance of a draw.
std::vector<std::uint32_t> upTo(std::size_t count) {
    std::vector<std::uint32_t> numbers(std::max<std::size_t>(count, 1));
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

// NOLINTNEXTLINE(performance-no-int-to-ptr): GL takes an offset into a buffer as a pointer
const void* at(std::size_t offset) {
    return reinterpret_cast<const void*>(offset);
}

// Index of the surface of a level, 0 for the control mesh.
std::size_t surfaceOf(DetailLevel level) {
    assert(level >= DetailLevel::ControlMesh);
    return std::size_t(level) - std::size_t(DetailLevel::ControlMesh);
}

// Sets the indices, and attribute 3: for each instance its place in the school.
void describe(const gl::VertexArray& array, const gl::Buffer& indices, const gl::Buffer& slots) {
    glVertexArrayElementBuffer(array.name(), indices.name());
    glVertexArrayVertexBuffer(array.name(), 1, slots.name(), 0, sizeof(std::uint32_t));
    glVertexArrayBindingDivisor(array.name(), 1, 1);
    glEnableVertexArrayAttrib(array.name(), 3);
    glVertexArrayAttribBinding(array.name(), 3, 1);
    glVertexArrayAttribIFormat(array.name(), 3, 1, GL_UNSIGNED_INT, 0);
}

// Sets attributes 0 to 2: the SkinPlace with which each vertex begins.
void addPlaces(const gl::VertexArray& array, const gl::Buffer& vertices, std::size_t stride) {
    glVertexArrayVertexBuffer(array.name(), 0, vertices.name(), 0, static_cast<GLsizei>(stride));
    for (const unsigned attribute : {0U, 1U, 2U}) {
        glEnableVertexArrayAttrib(array.name(), attribute);
        glVertexArrayAttribBinding(array.name(), attribute, 0);
    }
    const unsigned name = array.name();
    glVertexArrayAttribFormat(name, 0, 4, GL_FLOAT, GL_FALSE, offsetof(skin::SkinPlace, rest));
    glVertexArrayAttribFormat(name, 1, 2, GL_FLOAT, GL_FALSE, offsetof(skin::SkinPlace, fin));
    glVertexArrayAttribIFormat(name, 2, 1, GL_UNSIGNED_INT, offsetof(skin::SkinPlace, part));
}

}  // namespace

namespace {

// Of the fish of a species.
struct SpeciesShaders {
    SkinShader own;
    std::optional<SkinShader> drawn;  // where it takes drawings
    std::size_t firstFish = 0, fish = 0;
    bool isDrawn = false;  // in this frame one of them may wear a drawing

    // Calls draw(shader, where its draws are in the plan) for each thing that its fish wear.
    template <class Draw>
    void eachWorn(const Draw& draw) const {
        draw(own, offsetof(FishPlan, own));
        if (isDrawn) draw(*drawn, offsetof(FishPlan, drawn));
    }
};

// The numbers below `count` in an order of this process's own. Nodes of one machine share the cache
// of programs, and wait for a program that another compiles; so they compile different ones.
std::vector<std::size_t> ownOrder(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::shuffle(order, std::mt19937(static_cast<std::uint32_t>(getpid())));
    return order;
}

std::vector<SpeciesShaders> shadersOf(std::span<const SchoolSpecies> cast,
                                      const gl::Replacements& tier) {
    std::vector<std::optional<SkinShader>> own(cast.size());
    std::vector<std::optional<SkinShader>> drawn(cast.size());
    for (const std::size_t i : ownOrder(cast.size())) {
        own[i].emplace(cast[i], Worn::Own, tier);
        if (cast[i].takesDrawings) drawn[i].emplace(cast[i], Worn::Drawing, tier);
    }
    std::vector<SpeciesShaders> all;
    std::size_t firstFish = 0;
    for (std::size_t i = 0; i < cast.size(); ++i) {
        const std::size_t fish = cast[i].fish.size();
        all.push_back({*std::move(own[i]), std::move(drawn[i]), firstFish, fish});
        firstFish += fish;
    }
    return all;
}

}  // namespace

// Members in the order in which they are made: tables are computed on another thread while this one
// compiles programs, then uploaded.
struct SchoolSurface::Parts {
    Parts(std::span<const SchoolSpecies> members,
          const SurfaceOptions& surfaceOptions,
          std::shared_ptr<const SkinPrograms> skins)
        : options{surfaceOptions},
          limits{detailLimits(options.fineness)},
          arrays{std::async(std::launch::async, fishArrays, members, surfaceOf(options.finest))},
          programs{std::move(skins)},
          species{shadersOf(members, programs->replacements)},
          drawings{options.skinLevelsLeftOut},
          tables{arrays.get(), surfaceOf(options.finest)},
          records{members} {
        makeBuffers();
        makeVertexArrays();
        setConstants();
    }

    // Returns how many vertices a page holds.
    std::size_t makePages();
    void makeBuffers();
    void makeVertexArrays() const;
    void setConstants() const;
    // Which species have fish that may wear a drawing.
    void findDrawn(std::span<const motion::FishRecord> fish);
    void setView(unsigned program, const FrustumPlanes& frustum, const SharedView& shared) const;
    // The four kernels that cull, count, plan and scatter.
    void sort() const;
    // Makes the surfaces of all pages.
    void evaluate() const;
    void drawSurfaces(bool isFins) const;
    void drawPage(std::size_t page, bool isFins) const;
    // Of one species; commands: where those of its levels begin in the plan.
    void drawLevels(const SkinShader& skinShader, std::size_t commands, bool isFins) const;
    // Draws commands of each species that need no surface.
    void drawTails(std::size_t first,
                   std::size_t commands,
                   gl::ProgramHandle SkinShader::*program) const;
    void drawPoints() const;
    void drawFew() const;

    SurfaceOptions options;
    DetailLimits limits;
    // Computed while this thread compiles programs.
    std::future<FishArrays> arrays;
    std::shared_ptr<const SkinPrograms> programs;
    std::vector<SpeciesShaders> species;  // one a species
    DrawnSkins drawings;
    FishTables tables;
    SchoolRecords records;
    std::vector<gl::Buffer> pages;  // of surfaces
    gl::Buffer choices, counts, plan, school, slots;
    gl::VertexArray surfaceArray, fewArray, pointArray;
    gl::Buffer pointIndices{gl::makeBuffer(
        std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1}, "point indices")};
    gl::ProgramHandle cull{gl::makeProgram({"fish_cull.comp"})};
    gl::ProgramHandle scan{gl::makeProgram({"fish_scan.comp"})};
    gl::ProgramHandle planner{gl::makeProgram({"fish_plan.comp"})};
    gl::ProgramHandle scatter{gl::makeProgram({"fish_scatter.comp"})};
};

namespace {

std::size_t blockLimit() {
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    return static_cast<std::size_t>(bytes);
}

}  // namespace

std::size_t SchoolSurface::Parts::makePages() {
    const std::size_t fish = records.fish();
    const std::size_t most = options.levelsOfDetail
                                 ? std::min(kSurfaceBytes, kNearBytes + fish * kMeshBytes)
                                 : kMostSurfaceBytes;
    const std::size_t heroBytes = tables.mostVertices * kBytesPerVertex;
    const std::size_t heroes =
        std::clamp<std::size_t>(most / heroBytes, 1, std::max<std::size_t>(fish, 1));
    const std::size_t pageBytes =
        std::min({options.pageBytes, blockLimit() / 2, heroes * heroBytes});
    const std::size_t heroesAPage = std::max<std::size_t>(pageBytes / heroBytes, 1);
    pages.resize(std::min((heroes + heroesAPage - 1) / heroesAPage, kMostPages));
    const std::size_t room = pageBytes / kBytesPerVertex;
    assert(room > 0);
    for (gl::Buffer& page : pages) page = gl::makeBuffer(room * kBytesPerVertex, "fish surfaces");
    return room;
}

void SchoolSurface::Parts::makeBuffers() {
    const std::size_t fish = records.fish();
    const std::size_t room = makePages();
    choices = gl::makeBuffer(fish * sizeof(std::uint32_t), "fish choices");
    counts = gl::makeBuffer(tables.groups * kDetailStride * sizeof(std::uint32_t), "fish counts");
    plan = gl::makeBuffer(sizeof(FishPlan), "fish plan");
    school = gl::makeBuffer(fish * sizeof(DrawnFish), "fish drawn");
    slots = gl::makeBuffer(upTo(fish), "places in the school");
    glProgramUniform1ui(planner.name(), shaders::kRoomVerticesLocation, static_cast<GLuint>(room));
    for (const unsigned program : {planner.name(), scatter.name()})
        glProgramUniform1ui(
            program, shaders::kPageCountLocation, static_cast<GLuint>(pages.size()));
}

void SchoolSurface::Parts::makeVertexArrays() const {
    describe(surfaceArray, tables.indices, slots);
    addPlaces(surfaceArray, tables.places, sizeof(SurfaceVertex));
    const unsigned surfaces = surfaceArray.name();
    for (const unsigned attribute : {4U, 5U}) {
        glEnableVertexArrayAttrib(surfaces, attribute);
        glVertexArrayAttribBinding(surfaces, attribute, 0);
    }
    glVertexArrayAttribFormat(
        surfaces, 4, 4, GL_FLOAT, GL_FALSE, offsetof(SurfaceVertex, coarserRest));
    glVertexArrayAttribFormat(
        surfaces, 5, 2, GL_FLOAT, GL_FALSE, offsetof(SurfaceVertex, coarserFin));
    describe(fewArray, tables.fewIndices, slots);
    addPlaces(fewArray, tables.fewVertices, sizeof(FewTriangles::Vertex));
    const unsigned few = fewArray.name();
    for (const unsigned attribute : {4U, 5U}) {
        glEnableVertexArrayAttrib(few, attribute);
        glVertexArrayAttribBinding(few, attribute, 0);
    }
    using Vertex = FewTriangles::Vertex;
    glVertexArrayAttribIFormat(few, 4, 1, GL_UNSIGNED_INT, offsetof(Vertex, controlPoint));
    glVertexArrayAttribFormat(few, 5, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
    describe(pointArray, pointIndices, slots);
}

// Uniforms that never change.
void SchoolSurface::Parts::setConstants() const {
    for (const unsigned program : {cull.name(), scatter.name()}) {
        glProgramUniform1fv(
            program, shaders::kLimitsLocation, static_cast<GLsizei>(limits.size()), limits.data());
        glProgramUniform1ui(
            program, shaders::kFinestDetailLocation, static_cast<GLuint>(options.finest));
        glProgramUniform1i(
            program, shaders::kChoosesDetailLocation, options.levelsOfDetail ? 1 : 0);
    }
    glProgramUniform1i(cull.name(), shaders::kCullsLocation, options.culling ? 1 : 0);
    glProgramUniform1ui(
        planner.name(), shaders::kSpeciesCountLocation, static_cast<GLuint>(species.size()));
    std::array<GLuint, 2> drawn{};
    for (std::size_t s = 0; s < species.size(); ++s)
        if (species[s].drawn) drawn.at(s / 32) |= 1U << (s % 32);
    for (const unsigned program : {cull.name(), scatter.name()})
        glProgramUniform2uiv(program, shaders::kDrawnSpeciesLocation, 1, drawn.data());
}

void SchoolSurface::Parts::setView(unsigned program,
                                   const FrustumPlanes& frustum,
                                   const SharedView& shared) const {
    const glm::vec4 eye{shared.eyeMetres, shared.pixelRadians};
    glProgramUniform4fv(program, shaders::kPlanesLocation, 6, &frustum.planes.front().x);
    glProgramUniform4fv(program, shaders::kSharedEyeLocation, 1, &eye.x);
    glProgramUniform1f(program, shaders::kFractionLocation, records.fraction());
    glProgramUniform1ui(
        program, shaders::kFishCountLocation, static_cast<GLuint>(records.uploaded()));
}

void SchoolSurface::Parts::findDrawn(std::span<const motion::FishRecord> fish) {
    const auto wears = [](const motion::FishRecord& record) { return record.skin != 0; };
    for (SpeciesShaders& one : species) {
        const std::size_t first = std::min(one.firstFish, fish.size());
        const auto own = fish.subspan(first, std::min(one.fish, fish.size() - first));
        one.isDrawn = one.drawn && !drawings.isEmpty() && std::ranges::any_of(own, wears);
    }
}

// Cull and count, scan (where each group begins), plan (where each list begins, and the draws),
// scatter. Each kernel reads what the one before it wrote, hence the barriers.
void SchoolSurface::Parts::sort() const {
    const auto groups = static_cast<GLuint>(tables.groups);
    records.bind();
    drawings.bindTable();
    gl::bindStorage(shaders::kCastStorage, tables.cast);
    gl::bindStorage(shaders::kChoicesStorage, choices);
    gl::bindStorage(shaders::kCountsStorage, counts);
    gl::bindStorage(shaders::kPlanStorage, plan);
    gl::bindStorage(shaders::kSchoolStorage, school);
    // An earlier view has drawn from these buffers.
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glUseProgram(cull.name());
    glDispatchCompute(groups, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glUseProgram(scan.name());
    glDispatchCompute(static_cast<GLuint>(species.size()), kDetailStride, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glUseProgram(planner.name());
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glUseProgram(scatter.name());
    glDispatchCompute(groups, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void SchoolSurface::Parts::evaluate() const {
    const gl::Stage stage{"fish surfaces"};
    gl::bindStorage(shaders::kSchoolStorage, school);
    glBindTextureUnit(shaders::kRecordedUnit, tables.poses.name());
    gl::bindStorage(shaders::kFirstEntriesStorage, tables.firstEntries);
    gl::bindStorage(shaders::kEntriesStorage, tables.entries);
    gl::bindStorage(shaders::kCastStorage, tables.cast);
    gl::bindStorage(shaders::kPlanStorage, plan);
    gl::bindStorage(shaders::kParentsStorage, tables.parents);
    glUseProgram(programs->surface.name());
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, plan.name());
    // An earlier view has drawn from the pages.
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    for (std::size_t page = 0; page < pages.size(); ++page) {
        gl::bindStorage(shaders::kSurfaceStorage, pages[page]);
        glUniform1ui(shaders::kPageLocation, static_cast<GLuint>(page));
        glDispatchComputeIndirect(
            static_cast<GLintptr>(offsetof(FishPlan, pages) + page * sizeof(FishPlan::Page)));
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void SchoolSurface::Parts::drawSurfaces(bool isFins) const {
    glBindVertexArray(surfaceArray.name());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, plan.name());
    gl::bindStorage(shaders::kSchoolStorage, school);
    for (std::size_t page = 0; page < pages.size(); ++page) {
        gl::bindStorage(shaders::kSurfaceStorage, pages[page]);
        drawPage(page, isFins);
    }
}

// Consecutive levels of a species that use the same program go into one call.
void SchoolSurface::Parts::drawPage(std::size_t page, bool isFins) const {
    using Draws = FishPlan::Draws;
    const std::size_t table = isFins ? offsetof(Draws, fins) : offsetof(Draws, bodies);
    for (std::size_t s = 0; s < species.size(); ++s) {
        const std::size_t piece = (page * shaders::kMostSpecies + s) * kSurfaces;
        const std::size_t first = table + piece * sizeof(FishPlan::Command);
        species[s].eachWorn([&](const SkinShader& skinShader, std::size_t draws) {
            drawLevels(skinShader, draws + first, isFins);
        });
    }
}

void SchoolSurface::Parts::drawLevels(const SkinShader& skinShader,
                                      std::size_t commands,
                                      bool isFins) const {
    const std::size_t surfaces = 1 + surfaceOf(options.finest);
    const auto programOf = [&](std::size_t level) {
        return isFins ? skinShader.fins.name() : skinShader.bodyOf(static_cast<int>(level));
    };
    for (std::size_t first = 0; first < surfaces;) {
        const unsigned program = programOf(first);
        std::size_t last = first + 1;
        while (last < surfaces && programOf(last) == program) ++last;
        glUseProgram(program);
        glMultiDrawElementsIndirect(GL_TRIANGLES,
                                    GL_UNSIGNED_INT,
                                    at(commands + first * sizeof(FishPlan::Command)),
                                    static_cast<GLsizei>(last - first),
                                    sizeof(FishPlan::Command));
        first = last;
    }
}

void SchoolSurface::Parts::drawTails(std::size_t first,
                                     std::size_t commands,
                                     gl::ProgramHandle SkinShader::*program) const {
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, plan.name());
    for (std::size_t s = 0; s < species.size(); ++s)
        species[s].eachWorn([&](const SkinShader& skinShader, std::size_t draws) {
            glUseProgram((skinShader.*program).name());
            glMultiDrawElementsIndirect(GL_TRIANGLES,
                                        GL_UNSIGNED_INT,
                                        at(draws + offsetof(FishPlan::Draws, tails) +
                                           (s * kTails + first) * sizeof(FishPlan::Command)),
                                        static_cast<GLsizei>(commands),
                                        sizeof(FishPlan::Command));
        });
}

// Points are drawn before the few triangles that fade in over them. They do not write depth.
void SchoolSurface::Parts::drawPoints() const {
    gl::bindStorage(shaders::kSchoolStorage, school);
    gl::bindStorage(shaders::kCastStorage, tables.cast);
    glBindVertexArray(pointArray.name());
    glDepthMask(GL_FALSE);
    drawTails(2 * kMeshes, 1, &SkinShader::point);
    glDepthMask(GL_TRUE);
}

void SchoolSurface::Parts::drawFew() const {
    gl::bindStorage(shaders::kSchoolStorage, school);
    glBindTextureUnit(shaders::kRecordedUnit, tables.poses.name());
    glBindVertexArray(fewArray.name());
    glEnable(GL_CULL_FACE);
    drawTails(0, kMeshes, &SkinShader::fewBody);
    glDisable(GL_CULL_FACE);  // a fin is visible from both sides
    drawTails(kMeshes, kMeshes, &SkinShader::fewFins);
}

SchoolSurface::SchoolSurface(std::span<const SchoolSpecies> cast,
                             const SurfaceOptions& options,
                             std::shared_ptr<const SkinPrograms> skins)
    : parts_{std::make_unique<Parts>(cast, options, std::move(skins))} {}

SchoolSurface::~SchoolSurface() = default;
SchoolSurface::SchoolSurface(SchoolSurface&&) noexcept = default;
SchoolSurface& SchoolSurface::operator=(SchoolSurface&&) noexcept = default;

void SchoolSurface::wear(const body::SkinsByNumber& skins, std::size_t most) {
    parts_->drawings.wear(skins, most);
}

void SchoolSurface::update(const SchoolMoment& moment) {
    const gl::Stage stage{"fish records"};
    parts_->records.update(moment);
    parts_->findDrawn(moment.after);
}

void SchoolSurface::look(const glm::mat4& clipFromWorld, const SharedView& shared) {
    const gl::Stage stage{"fish sort"};
    const Parts& parts = *parts_;
    if (parts.records.fish() == 0) return;
    const FrustumPlanes frustum = frustumOf(clipFromWorld);
    for (const unsigned program : {parts.cull.name(), parts.scatter.name()})
        parts.setView(program, frustum, shared);
    parts.sort();
}

void SchoolSurface::drawBodies() const {
    const gl::Stage stage{"fish bodies"};
    if (parts_->records.fish() == 0) return;
    parts_->drawings.bindTexture();
    parts_->evaluate();
    glEnable(GL_CULL_FACE);
    parts_->drawSurfaces(false);
    glDisable(GL_CULL_FACE);
}

void SchoolSurface::drawBlended() const {
    const gl::Stage stage{"fish blended"};
    if (parts_->records.fish() == 0) return;
    parts_->drawings.bindTexture();
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    if (parts_->options.levelsOfDetail) {
        parts_->drawPoints();
        parts_->drawFew();
    }
    glEnable(GL_CULL_FACE);
    parts_->drawSurfaces(true);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
}

void SchoolSurface::bindRecords() const {
    parts_->records.bind();
}
std::size_t SchoolSurface::fishInRecords() const {
    return parts_->records.uploaded();
}
float SchoolSurface::fraction() const {
    return parts_->records.fraction();
}

SurfaceCounts SchoolSurface::counts() const {
    SurfaceCounts counts;
    if (parts_->records.fish() == 0) return counts;
    decltype(FishPlan::totals) totals{};
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(
        parts_->plan.name(), offsetof(FishPlan, totals), sizeof(totals), &totals);
    for (std::size_t s = 0; s < parts_->species.size(); ++s)
        for (std::size_t level = 0; level < kDetailLevels; ++level)
            counts.atLevel.at(level) +=
                totals.at(s).at(level) + totals.at(s).at(level + shaders::kDrawnLists);
    FishPlan::Draws draws[2];
    glGetNamedBufferSubData(parts_->plan.name(), offsetof(FishPlan, own), sizeof(draws), &draws);
    for (const FishPlan::Draws& worn : draws)
        for (std::size_t s = 0; s < parts_->species.size(); ++s)
            for (std::size_t surface = 0; surface < kSurfaces; ++surface)
                counts.withoutRoom += worn.tails.at(s).at(1 + surface).instances;
    counts.visible = std::accumulate(counts.atLevel.begin(), counts.atLevel.end(), std::size_t{0});
    return counts;
}

}  // namespace aquarama::surface
