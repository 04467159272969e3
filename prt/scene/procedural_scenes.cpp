#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "prt/base/error.h"
#include "prt/math/transform.h"
#include "prt/scene/framing.h"
#include "prt/scene/mesh_building.h"
#include "prt/scene/procedural.h"
#include "prt/scene/surface_color.h"

namespace prt {
namespace {

// A named base colour.
struct Paint {
    std::string name;
    Vec3f albedo;
    MetallicRoughness surface{};
};

// White, red and green are those of the Cornell box [Goral84], rounded.
const Paint kWhite{"white", Vec3f(0.73f, 0.71f, 0.68f)};
const Paint kRed{"red", Vec3f(0.63f, 0.07f, 0.05f)};
const Paint kGreen{"green", Vec3f(0.14f, 0.45f, 0.09f)};
const Paint kPorcelain{"porcelain", Vec3f(0.85f, 0.84f, 0.8f)};
const Paint kClay{"clay", Vec3f(0.8f, 0.8f, 0.8f)};
const Paint kGrey{"grey", Vec3f(0.5f, 0.5f, 0.5f)};
const Paint kMarble{"marble", Vec3f(0.8f, 0.77f, 0.7f)};
const Paint kSand{"sand", Vec3f(0.6f, 0.48f, 0.33f)};
const Paint kTerracotta{"terracotta", Vec3f(0.6f, 0.2f, 0.1f)};
const Paint kBlue{"blue", Vec3f(0.08f, 0.16f, 0.5f)};
const Paint kGold{"gold", Vec3f(0.8f, 0.5f, 0.1f)};

void addPart(Scene& scene, const std::string& name, const Paint& paint, Mesh mesh) {
    std::size_t material = 0;
    while (material < scene.materials.size() && scene.materials[material].name != paint.name)
        ++material;
    if (material == scene.materials.size()) {
        scene.materials.emplace_back().name = paint.name;
        scene.materials.back().baseColorFactor =
            Vec4f(paint.albedo.x, paint.albedo.y, paint.albedo.z, 1.0f);
        scene.materials.back().metallicFactor = paint.surface.metallic;
        scene.materials.back().roughnessFactor = paint.surface.roughness;
    }
    mesh.name = name;
    mesh.material = material;
    scene.meshes.push_back(std::move(mesh));
}

void addCamera(Scene& scene, const Vec3f& eye, const Vec3f& target, float fovDegrees) {
    scene.cameras.push_back(lookAt(eye, target, fovDegrees * 0.017453292519943296f));  // pi / 180
    scene.cameras.back().name = "main";
}

Mesh makeQuad(const Quad& quad, int alongCount, int acrossCount) {
    Mesh mesh;
    appendQuad(mesh, quad, alongCount, acrossCount);
    return mesh;
}

// Three walls around a square floor, red to the left and green to the
// right, open to the front and above.
void addWalls(Scene& scene, float halfWidth, float height, int cellsWide, int cellsHigh) {
    const Quad low = horizontalQuad(Vec3f(0.0f), 2.0f * halfWidth, 2.0f * halfWidth);
    const Vec3f up(0.0f, height, 0.0f);
    const auto wallBetween = [&](const Vec3f& a, const Vec3f& b) {
        return makeQuad({a, b, b + up, a + up}, cellsWide, cellsHigh);
    };
    addPart(scene, "left wall", kRed, wallBetween(low[0], low[3]));
    addPart(scene, "back wall", kWhite, wallBetween(low[3], low[2]));
    addPart(scene, "right wall", kGreen, wallBetween(low[2], low[1]));
}

Scene makeTeapotScene() {
    constexpr int kPatchCells = 24;
    constexpr int kRoomCells = 80;
    constexpr float kHalfWidth = 1.5f;
    constexpr float kClearance = 0.001f;  // keeps the bottom's lowest point off the floor's plane
    constexpr double kTurnRadians = -0.35;
    Mesh teapot = makeTeapot(kPatchCells);
    const Mat3d turn = rotationY(kTurnRadians);
    for (Vec3f& position : teapot.positions)
        position = turn * position + Vec3f(0.0f, kClearance, 0.0f);
    for (Vec3f& normal : teapot.normals)
        normal = (turn * normal).normalized();

    Scene scene;
    addPart(scene, "teapot", kPorcelain, std::move(teapot));
    addPart(scene, "floor", kWhite, makeFloor(kHalfWidth, 0.0f, kRoomCells));
    addWalls(scene, kHalfWidth, kHalfWidth, kRoomCells, kRoomCells / 2);
    addCamera(scene, Vec3f(0.0f, 1.6f, 4.6f), Vec3f(0.0f, 0.55f, 0.0f), 36.0f);
    return scene;
}

// A block on a floor tile that leaves a hole for it, so that block and
// floor meet in the same points.
struct Block {
    const char* name;
    Vec3f tileCenter;
    float tileWidth;
    Vec3f center;
    float width;
    float height;
    float turnRadians;
};

void addBlock(Scene& scene, Mesh& floor, const Block& block, const Paint& paint, int cellCount) {
    const Quad base = horizontalQuad(block.center, block.width, block.width, block.turnRadians);
    const Quad tile = horizontalQuad(block.tileCenter, block.tileWidth, block.tileWidth);
    appendRing(floor, quadLoop(tile, cellCount), quadLoop(base, cellCount), cellCount / 2);
    const Vec3f up(0.0f, block.height, 0.0f);
    const int cellsUp =
        static_cast<int>(std::lround(block.height / block.width * static_cast<float>(cellCount)));
    Mesh mesh;
    appendPrismSides(mesh, base, block.height, cellCount, cellsUp);
    appendQuad(mesh, {base[0] + up, base[1] + up, base[2] + up, base[3] + up}, cellCount,
               cellCount);
    addPart(scene, block.name, paint, std::move(mesh));
}

Scene makeCornellScene() {
    constexpr int kTileCells = 32;
    Scene scene;
    Mesh floor;
    addBlock(scene, floor,
             {"tall block", Vec3f(-0.5f, 0.0f, -0.5f), 1.0f, Vec3f(-0.48f, 0.0f, -0.48f), 0.58f,
              1.16f, 0.28f},
             kWhite, kTileCells);
    addBlock(scene, floor,
             {"short block", Vec3f(0.5f, 0.0f, 0.5f), 1.0f, Vec3f(0.48f, 0.0f, 0.48f), 0.58f, 0.58f,
              -0.28f},
             kWhite, kTileCells);
    appendQuad(floor, horizontalQuad(Vec3f(0.5f, 0.0f, -0.5f), 1.0f, 1.0f), kTileCells, kTileCells);
    appendQuad(floor, horizontalQuad(Vec3f(-0.5f, 0.0f, 0.5f), 1.0f, 1.0f), kTileCells, kTileCells);
    addPart(scene, "floor", kWhite, std::move(floor));
    addWalls(scene, 1.0f, 2.0f, 2 * kTileCells, 2 * kTileCells);
    addCamera(scene, Vec3f(0.0f, 1.2f, 4.2f), Vec3f(0.0f, 0.95f, 0.0f), 37.0f);
    return scene;
}

// The temple of the scene "columns", laid out on tiles of one metre: which of them carry a column.
constexpr int kTempleTilesX = 3;  // to either side of the middle tile
constexpr int kTempleTilesZ = 2;
constexpr int kTileCells = 10;
constexpr float kBaseRadius = 0.24f;
constexpr float kTopRadius = 0.19f;
constexpr float kColumnHeight = 2.4f;
constexpr float kBeamHeight = 0.4f;
constexpr float kGableHeight = 1.0f;

bool carriesColumn(int x, int z) {
    const bool onLongSide =
        std::abs(z) == kTempleTilesZ && std::abs(x) % 2 == 1 && std::abs(x) <= kTempleTilesX;
    const bool onShortSide = std::abs(x) == kTempleTilesX && z == 0;
    return onLongSide || onShortSide;
}

// A tile facing up, with a round hole if it carries a column.
void appendTempleTile(Mesh& mesh, int x, int z, float height, float columnRadius) {
    const Vec3f center(static_cast<float>(x), height, static_cast<float>(z));
    const Quad tile = horizontalQuad(center, 1.0f, 1.0f);
    if (carriesColumn(x, z)) {
        appendRing(mesh, quadLoop(tile, kTileCells),
                   circleLoop(center, columnRadius, 4 * kTileCells), kTileCells / 2);
    } else {
        appendQuad(mesh, tile, kTileCells, kTileCells);
    }
}

Mesh makeTempleCeiling() {
    Mesh ceiling;
    for (int z = -kTempleTilesZ; z <= kTempleTilesZ; ++z) {
        for (int x = -kTempleTilesX; x <= kTempleTilesX; ++x) {
            appendTempleTile(ceiling, x, z, kColumnHeight, kTopRadius);
        }
    }
    turnInsideOut(ceiling);
    return ceiling;
}

Mesh makeTempleColumns() {
    Mesh columns;
    for (int z = -kTempleTilesZ; z <= kTempleTilesZ; ++z) {
        for (int x = -kTempleTilesX; x <= kTempleTilesX; ++x) {
            if (!carriesColumn(x, z)) continue;
            const Vec3f center(static_cast<float>(x), 0.0f, static_cast<float>(z));
            appendTaper(columns, {center, kColumnHeight, kBaseRadius, kTopRadius}, 4 * kTileCells,
                        24);
        }
    }
    return columns;
}

// The beam that lies on the columns, one metre of each side at a time, and the two gables above it.
Mesh makeTempleBeam() {
    const Vec3f up(0.0f, kBeamHeight, 0.0f);
    const float x = static_cast<float>(kTempleTilesX) + 0.5f;
    const float z = static_cast<float>(kTempleTilesZ) + 0.5f;
    Mesh beam;
    const auto appendSide = [&](const Vec3f& from, const Vec3f& to) {
        const Vec3f step = (to - from).normalized();
        const int tileCount = static_cast<int>(std::lround((to - from).length()));
        for (int tile = 0; tile < tileCount; ++tile) {
            const Vec3f a = from + step * static_cast<float>(tile), b = a + step;
            appendQuad(beam, {a, b, b + up, a + up}, kTileCells, 4);
        }
    };
    const Quad base = horizontalQuad(Vec3f(0.0f, kColumnHeight, 0.0f), 2.0f * x, 2.0f * z);
    for (std::size_t i = 0; i < 4; ++i)
        appendSide(base[i], base[(i + 1) % 4]);

    const int halfCells = (2 * kTempleTilesX + 1) * kTileCells / 2;
    for (const float side : {1.0f, -1.0f}) {
        const Vec3f middle(0.0f, kColumnHeight + kBeamHeight, side * z);
        const Vec3f ridge = middle + Vec3f(0.0f, kGableHeight, 0.0f);
        const Vec3f toRight(side * x, 0.0f, 0.0f);
        appendTriangle(beam, {middle - toRight, middle, ridge}, halfCells);
        appendTriangle(beam, {middle, middle + toRight, ridge}, halfCells);
    }
    return beam;
}

Mesh makeTempleRoof() {
    const int slopeCells = (2 * kTempleTilesX + 1) * kTileCells / 2;
    const int lengthCells = (2 * kTempleTilesZ + 1) * kTileCells;
    const Quad eaves = horizontalQuad(Vec3f(0.0f, kColumnHeight + kBeamHeight, 0.0f),
                                      2.0f * static_cast<float>(kTempleTilesX) + 1.0f,
                                      2.0f * static_cast<float>(kTempleTilesZ) + 1.0f);
    const Vec3f ridgeFront(0.0f, eaves[0].y + kGableHeight, eaves[0].z);
    const Vec3f ridgeBack(0.0f, eaves[3].y + kGableHeight, eaves[3].z);
    Mesh roof;
    appendQuad(roof, {eaves[0], ridgeFront, ridgeBack, eaves[3]}, slopeCells, lengthCells);
    appendQuad(roof, {ridgeFront, eaves[1], eaves[2], ridgeBack}, slopeCells, lengthCells);
    return roof;
}

Scene makeColumnsScene() {
    constexpr int kGroundTilesX = 4;
    constexpr int kGroundTilesZ = 3;
    constexpr Block kPlinth{"plinth", Vec3f(0.0f), 1.0f, Vec3f(0.0f), 0.7f, 0.7f, 0.0f};
    constexpr float kBallRadius = 0.4f;
    constexpr float kClearance = 0.005f;
    Scene scene;
    Mesh ground;
    for (int z = -kGroundTilesZ; z <= kGroundTilesZ; ++z) {
        for (int x = -kGroundTilesX; x <= kGroundTilesX; ++x) {
            if (x != 0 || z != 0) appendTempleTile(ground, x, z, 0.0f, kBaseRadius);
        }
    }
    addBlock(scene, ground, kPlinth, kBlue, kTileCells);
    addPart(scene, "ground", kSand, std::move(ground));
    addPart(scene, "columns", kMarble, makeTempleColumns());
    addPart(scene, "ceiling", kMarble, makeTempleCeiling());
    addPart(scene, "beam", kMarble, makeTempleBeam());
    addPart(scene, "roof", kTerracotta, makeTempleRoof());
    const Vec3f ballCenter(0.0f, kPlinth.height + kClearance + kBallRadius, 0.0f);
    addPart(scene, "ball", kGold, makeSphere(ballCenter, kBallRadius, 64));
    addCamera(scene, Vec3f(2.2f, 2.1f, 10.0f), Vec3f(0.0f, 1.65f, 0.0f), 42.0f);
    return scene;
}

Scene makeBowlScene() {
    constexpr int kSegments =
        320;  // some 51,000 triangles: transfer within half a percent of the sphere's
    Scene scene;
    addPart(scene, "bowl", kClay, makeBowl(0.0f, kSegments));
    addCamera(scene, Vec3f(0.9f, 1.1f, 2.6f), Vec3f(0.0f, 0.0f, -0.3f), 40.0f);
    return scene;
}

Scene makeSphereOverPlaneScene() {
    Scene scene;
    addPart(scene, "sphere", kWhite, makeSphere(Vec3f(0.0f, 2.0f, 0.0f), 1.0f, 128));
    addPart(scene, "plane", kGrey, makeFloor(8.0f, 0.0f, 128));
    addCamera(scene, Vec3f(0.0f, 4.0f, 10.0f), Vec3f(0.0f, 1.2f, 0.0f), 36.0f);
    return scene;
}

Scene makeBlockerScene() {
    Scene scene;
    addPart(scene, "blocker", kWhite,
            makeBox(Vec3f(-0.5f, 0.7f, -0.5f), Vec3f(0.5f, 0.8f, 0.5f), false, 16));
    addPart(scene, "plane", kWhite, makeFloor(2.0f, 0.0f, 128));
    addCamera(scene, Vec3f(0.0f, 3.6f, 4.2f), Vec3f(0.0f, 0.2f, 0.0f), 42.0f);
    return scene;
}

Scene makeBoxScene() {
    Scene scene;
    addPart(scene, "room", kWhite, makeBox(Vec3f(-1.0f), Vec3f(1.0f), true, 32));
    addCamera(scene, Vec3f(0.0f, 0.0f, 0.9f), Vec3f(0.0f, 0.0f, 0.0f), 70.0f);
    return scene;
}

// Two rows, each from a mirror to matt: metal at the back, lacquer in front.
Scene makeMaterialsScene() {
    constexpr int kSphereSegments = 64;
    constexpr int kFloorCells = 96;
    constexpr float kRadius = 0.42f;
    constexpr float kClearance = 0.001f;
    const std::array<std::string, 5> roughnesses = {"0.1", "0.3", "0.5", "0.7", "1"};
    const Paint copper{"metal ", Vec3f(0.89f, 0.6f, 0.5f), {.metallic = 1.0f}};
    const Paint lacquer{"lacquer ", Vec3f(0.08f, 0.2f, 0.5f)};

    Scene scene;
    for (const auto& [row, z] : {std::pair(copper, -0.6f), std::pair(lacquer, 0.6f)}) {
        float x = -2.0f;
        for (const std::string& roughness : roughnesses) {
            Paint paint = row;
            paint.name += roughness;
            paint.surface.roughness = std::stof(roughness);
            addPart(scene, paint.name, paint,
                    makeSphere(Vec3f(x, kRadius + kClearance, z), kRadius, kSphereSegments));
            x += 1.0f;
        }
    }
    addPart(scene, "floor", kWhite, makeFloor(3.0f, 0.0f, kFloorCells));
    addCamera(scene, Vec3f(0.0f, 3.6f, 5.0f), Vec3f(0.0f, 0.2f, 0.05f), 30.0f);
    return scene;
}

constexpr std::array<ProceduralScene, 8> kScenes{{
    {"teapot", "the Utah teapot between a red and a green wall", makeTeapotScene},
    {"cornell", "two blocks in a Cornell box open to the front and the top", makeCornellScene},
    {"columns", "a small temple: soft shadows, and colour bleeding under its roof",
     makeColumnsScene},
    {"bowl", "the inside of a hemisphere, whose interreflection has a closed form", makeBowlScene},
    {"sphere-over-plane", "a unit sphere two metres above a plane, whose shadow has a closed form",
     makeSphereOverPlaneScene},
    {"blocker", "a slab above a plane: how sharp a shadow each number of bands can hold",
     makeBlockerScene},
    {"materials", "ten spheres on a floor, metal and lacquer, from mirrors to matt",
     makeMaterialsScene},
    {"box", "a closed room seen from inside, where no light may leak in", makeBoxScene},
}};

}  // namespace

std::span<const ProceduralScene> proceduralScenes() {
    return kScenes;
}

Scene makeProceduralScene(std::string_view name) {
    std::string names;
    for (const ProceduralScene& scene : kScenes) {
        if (scene.name == name) return scene.make();
        names += (names.empty() ? "" : ", ") + std::string(scene.name);
    }
    throw Error(ErrorCode::invalidOption, "there is no scene of that name", std::string(name),
                "choose one of " + names);
}

}  // namespace prt
