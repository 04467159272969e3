// Damaged variants of assets and what the library makes of each, for web/loader to make the same of
// them: how to damage the file, and the relit numbers, or null where it is refused. As JSON on the
// standard output, the same at every run.
// write_damaged_assets ASSET.prt.glb... > damaged_assets.json
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>

#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/gltf/gltf_scene.h"
#include "tests/asset/asset_builder.h"
#include "tests/web/relit_layer.h"

namespace {

using namespace prt;
using test::GlbFile;
using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;

constexpr int kFlipCount = 150;
constexpr int kCutCount = 30;
constexpr int kForgedByteCount = 60;
constexpr int kChangedMemberCount = 400;

std::mt19937 random32(9);  // the same numbers everywhere

std::size_t drawIndex(std::size_t count) {
    return random32() % count;
}

/// One number a layer, which no change of what the layer holds leaves as it was. Red, green and
/// blue of coefficient i of the light are 1, 2 and 3 over i + 1.
Json sumNumbers(const Asset& asset) {
    Lighting lighting(asset.transfer.bandCount);
    for (std::size_t i = 0; i < lighting.coefficients.size(); ++i)
        lighting.coefficients[i] = Vec3d(1.0, 2.0, 3.0) / static_cast<double>(i + 1);
    Json sums = Json::array();
    for (const CompressedLayer& layer : asset.transfer.layers) {
        double sum = 0.0;
        double k = 0.0;
        for (const double number : test::relightLayer(asset.transfer, layer, lighting))
            sum += number * std::cos(k++);
        sums.push_back(sum);
    }
    return sums;
}

/// @param edit  how the test damages the file itself
Json judge(Json edit, Bytes damaged) {
    try {
        edit["numbers"] = sumNumbers(decodeAsset(std::move(damaged), "damaged.prt.glb"));
    } catch (const Error&) {
        edit["numbers"] = nullptr;
    }
    return edit;
}

/// A byte of the file is another.
Json flipBit(const Bytes& bytes) {
    Bytes damaged = bytes;
    const std::size_t at = drawIndex(bytes.size());
    damaged[at] ^= std::byte{1} << drawIndex(8);
    return judge({{"bytes", {{at, std::to_integer<int>(damaged[at])}}}}, damaged);
}

/// The file ends early, or goes on with zeros.
Json cut(const Bytes& bytes) {
    Bytes damaged = bytes;
    damaged.resize(drawIndex(10) == 0 ? bytes.size() + 1 + drawIndex(8) : drawIndex(bytes.size()));
    return judge({{"size", damaged.size()}}, damaged);
}

/// The file is put together again from what was changed: JSON by a patch (RFC 6902), and bytes of
/// the binary chunk. @param isForged  whether checksums are made to fit
Json judgeChange(const GlbFile& original, GlbFile changed, bool isForged) {
    if (isForged) test::repairWhatCanBe(changed);
    Json binary = Json::array();
    for (std::size_t i = 0; i < original.binary.size(); ++i)
        if (changed.binary[i] != original.binary[i])
            binary.push_back({i, std::to_integer<int>(changed.binary[i])});
    return judge({{"patch", Json::diff(original.json, changed.json)}, {"binary", binary}},
                 test::joinGlb(changed));
}

Json forgeByte(const GlbFile& original) {
    GlbFile changed = original;
    const std::size_t at = drawIndex(changed.binary.size());
    const std::byte extremes[] = {std::byte{0}, std::byte{0x7f}, std::byte{0xff}};
    changed.binary[at] = drawIndex(2) ? extremes[drawIndex(3)] : std::byte(random32() % 256);
    return judgeChange(original, changed, true);
}

/// Where all values of a document stand, objects and lists included.
void listPlaces(const Json& value, const Json::json_pointer& place,
                std::vector<Json::json_pointer>& places) {
    if (!place.empty()) places.push_back(place);
    if (value.is_object())
        for (const auto& [key, member] : value.items())
            listPlaces(member, place / key, places);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i)
            listPlaces(value[i], place / i, places);
}

/// What no place, or nearly none, can hold.
const Json& drawAbsurdity() {
    static const Json kAbsurdities = {nullptr,
                                      true,
                                      false,
                                      "",
                                      "x",
                                      "2.0",
                                      "00000000",
                                      -1,
                                      0,
                                      1,
                                      2,
                                      255,
                                      65536,
                                      2.5,
                                      1e30,
                                      -1e30,
                                      4294967296,
                                      9007199254740991,
                                      1e17,
                                      Json::array(),
                                      Json::object(),
                                      {0},
                                      {1, 1},
                                      {{"x", 1}}};
    return kAbsurdities[drawIndex(kAbsurdities.size())];
}

void erase(Json& json, const Json::json_pointer& place) {
    Json& parent = json[place.parent_pointer()];
    if (parent.is_object())
        parent.erase(place.back());
    else
        parent.erase(static_cast<std::size_t>(std::stoul(place.back())));
}

void changeMember(Json& json) {
    std::vector<Json::json_pointer> places;
    listPlaces(json, Json::json_pointer(), places);
    const Json::json_pointer place = places[drawIndex(places.size())];
    Json& value = json[place];
    switch (drawIndex(5)) {
        case 0:
            return erase(json, place);
        case 1:
            value = json.at(places[drawIndex(places.size())]);
            return;
        case 2:
            if (value.is_number_integer()) {
                value = value.get<std::int64_t>() + (drawIndex(2) ? 1 : -1);
                return;
            }
            if (value.is_array() && !value.empty()) return value.push_back(Json(value.back()));
            if (value.is_object()) {
                value["novelty"] = 1;
                return;
            }
            [[fallthrough]];
        default:
            value = drawAbsurdity();
    }
}

Json changeMember(const GlbFile& original) {
    GlbFile changed = original;
    changeMember(changed.json);
    return judgeChange(original, changed, drawIndex(2) == 0);
}

/// Versions, and extensions that are lost or too many.
std::vector<Json> changeNames(const GlbFile& original) {
    std::vector<Json> cases;
    for (const char* version :
         {"0.9",  "1.0",  "1.1",  "1.2",  "1.3",   "1.99",         "2.0",          "01.2",
          "1.02", "1",    "1.",   ".2",   "1.2.0", "1.x",          "v1.2",         "-1.2",
          "1.-2", " 1.2", "1.2 ", "+1.2", "1.+2",  "1.2147483648", "2147483648.0", ""}) {
        GlbFile changed = original;
        test::headerOf(changed)["version"] = version;
        cases.push_back(judgeChange(original, changed, false));
    }
    for (const char* extension : {"OPENPRT_radiance_transfer", "EXT_meshopt_compression",
                                  "KHR_mesh_quantization", "KHR_draco_mesh_compression", "x"})
        for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
            GlbFile changed = original;
            changed.json[list].push_back(extension);
            cases.push_back(judgeChange(original, changed, false));
        }
    GlbFile without = original;
    without.json.erase("extensions");
    cases.push_back(judgeChange(original, without, false));
    return cases;
}

Json damage(const Bytes& bytes) {
    const GlbFile file = test::splitGlb(bytes);
    Json cases = changeNames(file);
    for (int i = 0; i < kFlipCount; ++i)
        cases.push_back(flipBit(bytes));
    for (int i = 0; i < kCutCount; ++i)
        cases.push_back(cut(bytes));
    for (int i = 0; i < kForgedByteCount; ++i)
        cases.push_back(forgeByte(file));
    for (int i = 0; i < kChangedMemberCount; ++i)
        cases.push_back(changeMember(file));
    return cases;
}

}  // namespace

int main(int argumentCount, char** arguments) try {
    const char* separator = "[";
    for (int i = 1; i < argumentCount; ++i) {
        const std::filesystem::path path = arguments[i];
        for (Json& item : damage(readFile(path, GltfLimits().maxFileBytes))) {
            item["file"] = path.filename();
            std::cout << separator << item.dump();
            separator = ",\n";
        }
    }
    std::cout << "]\n";
    return std::cout ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "write_damaged_assets: %s\n", error.what());
    return 1;
}
