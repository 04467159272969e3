// Writes a few small good files for each fuzz target, to start from:
//   fuzz_make_seeds FOLDER      writes FOLDER/<target>/<seed>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "fuzz/checkpoint_target.h"
#include "fuzz/exr_seeds.h"
#include "prt/io/environment_io.h"
#include "prt/io/exr.h"
#include "prt/io/image_io.h"
#include "prt/scene/procedural.h"
#include "prt/transport/bake_settings.h"
#include "tests/asset/asset_builder.h"
#include "tests/gltf/full_file.h"
#include "tests/gltf/meshopt_file.h"
#include "tests/io/exr_bytes.h"
#include "tests/io/png_bytes.h"

namespace {

namespace fs = std::filesystem;
using prt::test::GltfBuilder;

class SeedFolder {
  public:
    explicit SeedFolder(fs::path folder) : folder_(std::move(folder)) {}

    void write(const char* target, const std::string& name, std::string_view bytes) const {
        fs::create_directories(folder_ / target);
        std::ofstream file(folder_ / target / name, std::ios::binary);
        if (!(file << bytes).flush()) throw std::runtime_error("a seed could not be written");
    }
    void write(const char* target, const std::string& name,
               std::span<const std::byte> bytes) const {
        write(target, name,
              std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }
    /// As fuzz/glb_parts.h takes a binary glTF apart.
    void writeParts(const char* target, const std::string& name, const std::string& json,
                    std::span<const std::byte> binary) const {
        write(
            target, name,
            json + '\0' + std::string(reinterpret_cast<const char*>(binary.data()), binary.size()));
    }

  private:
    fs::path folder_;
};

void writeGltf(const SeedFolder& seeds) {
    GltfBuilder strip = prt::test::makeTriangleFile();
    strip.json["meshes"][0]["primitives"][0]["mode"] = 5;
    const std::pair<const char*, GltfBuilder> files[] = {
        {"full", prt::test::makeFullFile()},
        {"tetrahedron", prt::test::makeTetrahedronFile({{"translation", {1, 2, 3}}})},
        {"strip", strip},
        {"meshopt", prt::test::makeMeshoptFile()}};
    for (const auto& [name, builder] : files) {
        seeds.write("gltf", name, builder.gltf());
        seeds.write("glb", name, builder.glb());
        seeds.writeParts("gltf_parts", name, builder.finished().dump(), builder.bytes);
    }
}

void writeAsset(const SeedFolder& seeds, const std::string& name, const prt::Scene& scene,
                const prt::CompressedTransfer& transfer) {
    const std::vector<std::byte> asset =
        prt::encodeAsset(scene, transfer, prt::test::makeProvenance());
    seeds.write("asset", name, asset);
    const prt::test::GlbFile parts = prt::test::splitGlb(asset);
    seeds.writeParts("asset_repaired", name, parts.json.dump(), parts.binary);
}

void writeAssets(const SeedFolder& seeds) {
    const prt::Scene scene = prt::test::makeTwoGrids();
    const std::vector<prt::Transport> transports = {prt::Transport::shadowed,
                                                    prt::Transport::interreflected};
    const std::vector<prt::Transport> glossy = {prt::Transport::glossyShadowed,
                                                prt::Transport::glossy};
    for (const prt::TransferEncoding encoding :
         {prt::TransferEncoding::float32, prt::TransferEncoding::unorm16,
          prt::TransferEncoding::unorm8}) {
        const std::string name(prt::encodingName(encoding));
        writeAsset(seeds, name, scene, prt::test::makeTransfer(scene, 2, encoding, transports));
        const prt::test::ClusterForm form{.weights = encoding, .vectors = encoding};
        writeAsset(seeds, "clusters-" + name, scene,
                   prt::test::makeClusteredTransfer(scene, 2, form, transports));
        writeAsset(seeds, "matrices-" + name, scene,
                   prt::test::makeTransfer(scene, 2, encoding, glossy));
        writeAsset(seeds, "matrix-clusters-" + name, scene,
                   prt::test::makeClusteredTransfer(scene, 2, form, glossy));
    }
    prt::Scene grid = prt::test::makeTwoGrids();
    grid.meshes = {prt::test::makeGrid("floor", 12, 0.0f)};
    seeds.write("asset", "meshopt",
                prt::encodeAsset(grid,
                                 prt::test::makeTransfer(grid, 1, prt::TransferEncoding::unorm8,
                                                         {prt::Transport::shadowed}),
                                 prt::test::makeProvenance(), {.meshopt = true}));
}

void writeObj(const SeedFolder& seeds) {
    seeds.write("obj", "square",
                "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
                "usemtl red\nf 1/1/1 2/2/1 3//1 4\nusemtl blue\nf -4 -3 -2\n");
    seeds.write("obj", "concave",
                "v 0 0 0 1 0 0\nv 2 0 0\nv 2 2 0\nv 1 .5 0\nv 0 2e0 0\nf 1 2 3 \\\n4 5\nl 1 2\n"
                "p 1\ng group\ns off\nvn 0 0 0\nf 1//1 2//1 3//1\n");
    seeds.write("mtl", "materials",
                "# two\nnewmtl red\nKd 1 0 0\nKe 0 0 2\nd 0.5\nmap_Kd -clamp on -s 1 1 1 a.png\n"
                "newmtl blue\nKd xyz 1\nTr 0.25\nillum 2\nmap_d b.png\nKs spectral a.rfl 1\n");
}

void writePly(const SeedFolder& seeds) {
    const std::string vertices =
        " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string faces =
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    seeds.write("ply", "ascii",
                "ply\nformat ascii" + vertices +
                    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float "
                    "nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float "
                    "t\nelement camera 1\nproperty list uint short q\n" +
                    faces +
                    "0 0 0 9 8 7 0 0 1 0 0\n1 0 0 9 8 7 0 0 1 0 0\n0 1 0 9 8 7 0 0 0 1 1\n"
                    "2 7 7\n3 0 1 2\n");
    std::string little = "ply\nformat binary_little_endian" + vertices + faces;
    std::string big = "ply\nformat binary_big_endian" + vertices + faces;
    for (const float number : prt::test::kTriangle) {
        prt::test::append(little, number);
        prt::test::appendBigEndian(big, number);
    }
    little += '\3', big += '\3';
    for (const std::int32_t corner : {0, 1, 2}) {
        prt::test::append(little, corner);
        prt::test::appendBigEndian(big, corner);
    }
    seeds.write("ply", "little", little);
    seeds.write("ply", "big", big);
}

void writePictures(const SeedFolder& seeds) {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    seeds.write("hdr", "flat", header + "-Y 1 +X 2\n\x80\x40\x20\x81\x10\x40\x20\x80");
    seeds.write("hdr", "runs",
                header + "-Y 1 +X 8\n" + std::string("\x02\x02\x00\x08", 4) +
                    "\x88\x80\x08\1\2\3\4\5\6\7\x08\x84\x40\x84\x20\x88\x81");
    seeds.write("hdr", "old_runs", header + "-Y 1 +X 4\n\x80\x40\x20\x81\1\1\1\3");
    seeds.write("png_jpeg", "stored.png", prt::test::PngBytes{.rows = std::string(4, '\0')}.file());
    seeds.write("png_jpeg", "deflated.png",
                prt::encodePng(prt::Rgba8Image(9, 7, {.red = 9, .alpha = 128})));
    seeds.write(
        "png_jpeg", "deep.png",
        prt::test::PngBytes{.bitDepth = 16, .colorType = 6, .rows = std::string(9, '\0')}.file());
    seeds.write("png_jpeg", "grey.jpg", prt::test::makeGreyJpeg());
    seeds.write("exr", "uncompressed", prt::test::ExrBytes{.samples = {0.5f, 1.0f, 2.0f}}.file());
    for (const auto& [name, bytes] : prt::fuzz::makeExrSeeds())
        seeds.write("exr", name, bytes);
}

void writeMerl(const SeedFolder& seeds) {
    std::string header;
    for (const std::int32_t size : {90, 90, 180})
        prt::test::append(header, size);
    std::string values = header;
    for (const double value : {477.5, 0.0, -1.0})
        prt::test::append(values, value);
    seeds.write("merl", "header", header);
    seeds.write("merl", "values", values);
}

void writeLights(const SeedFolder& seeds) {
    prt::Lighting lighting(2);
    lighting.coefficients = {{3.5, 3.5, 3.5}, {1e-3, 0.0, -2.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}};
    for (const prt::ShConvention convention :
         {prt::ShConvention::cs, prt::ShConvention::rh, prt::ShConvention::unity})
        seeds.write("light_json", std::string(prt::shConventionName(convention)),
                    prt::lightingToJson(lighting, convention));
}

void writeCheckpoints(const SeedFolder& seeds) {
    const prt::GatherUnitShape shape = prt::fuzz::unitShape();
    prt::GatherUnit unit;
    unit.transfer.assign(shape.receivers.size() * shape.coefficientCount, 0.25f);
    unit.slab.rowEnds = {1, 3};
    unit.slab.entries = {{1, prt::Vec3f(0.5f)}, {2, prt::Vec3f(0.1f)}, {7, prt::Vec3f(0.2f)}};
    const std::vector<std::byte> payload = prt::encodeGatherUnit(unit, shape);
    seeds.write("checkpoint", "payload", payload);
    seeds.write("checkpoint", "unit",
                prt::encodeUnit(prt::fuzz::kWorkFingerprint, prt::fuzz::unitKey(), payload));
    seeds.write("checkpoint", "manifest",
                prt::encodeManifest(
                    prt::bakeSettings(prt::makeProceduralScene("blocker"), {}, prt::Isa::avx2)));
}

}  // namespace

int main(int argumentCount, char** arguments) {
    if (argumentCount != 2) {
        std::fprintf(stderr, "usage: fuzz_make_seeds FOLDER\n");
        return 2;
    }
    const SeedFolder seeds{fs::path(arguments[1])};
    writeGltf(seeds);
    writeAssets(seeds);
    writeObj(seeds);
    writePly(seeds);
    writePictures(seeds);
    writeMerl(seeds);
    writeLights(seeds);
    writeCheckpoints(seeds);
    return 0;
}
