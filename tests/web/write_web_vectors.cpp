// What the library computes, for web/loader to compute the same: spherical harmonics, rotations,
// windows, lights, projections of images, and relit assets, as JSON on the standard output.
// write_web_vectors ASSET.prt.glb... > web/loader/test/vectors.json
#include <cstdio>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "prt/io/radiance_hdr.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/deringing.h"
#include "prt/light/lat_long_projection.h"
#include "tests/gltf/gltf_builder.h"
#include "tests/web/relit_layer.h"
#include "tests/web/shown_surface.h"

namespace {

using namespace prt;
using Json = nlohmann::ordered_json;

std::mt19937 random32(8);  // the same numbers everywhere

double drawNumber() {  // in [-1, 1)
    return static_cast<double>(random32()) / 2147483648.0 - 1.0;
}

Vec3d drawDirection() {
    while (true) {
        const Vec3d point(drawNumber(), drawNumber(), drawNumber());
        if (point.length() > 0.1 && point.length() <= 1.0) return point.normalized();
    }
}

Json toJson(const Vec3d& vector) {
    return {vector.x, vector.y, vector.z};
}

Json toJson(const Lighting& lighting) {
    Json coefficients = Json::array();
    for (const Vec3d& coefficient : lighting.coefficients)
        coefficients.push_back(toJson(coefficient));
    return {{"bands", lighting.bandCount}, {"convention", "cs"}, {"coefficients", coefficients}};
}

/// Light as it comes: a bright mean, and less of the higher bands.
Lighting drawLighting(int bandCount) {
    Lighting lighting(bandCount);
    for (int l = 0; l < bandCount; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            lighting.coefficients[static_cast<std::size_t>(i)] =
                l == 0 ? Vec3d(3.0, 2.5, 2.0)
                       : Vec3d(drawNumber(), drawNumber(), drawNumber()) / (0.5 + l);
    return lighting;
}

Json writeBases() {
    Json cases = Json::array();
    for (int k = 0; k < 8; ++k) {
        const Vec3d direction = k == 0 ? Vec3d(0, 0, -1) : drawDirection();
        std::vector<double> values(kMaxBandCount * kMaxBandCount);
        evaluateSh(direction, kMaxBandCount, values);
        cases.push_back({{"direction", toJson(direction)}, {"values", values}});
    }
    return cases;
}

Json writeRotations() {
    Json cases = Json::array();
    for (int k = 0; k < 4; ++k) {
        const Mat3d matrix =
            rotationZ(3 * drawNumber()) * rotationY(3 * drawNumber()) * rotationX(3 * drawNumber());
        Json entries = Json::array();
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                entries.push_back(matrix[row][column]);
        const Lighting lighting = drawLighting(k == 0 ? kMaxBandCount : 3 + k);
        cases.push_back({{"matrix", entries},
                         {"lighting", toJson(lighting)},
                         {"rotated", toJson(rotate(lighting, matrix))}});
    }
    return cases;
}

Json writeWindows() {
    Json cases = Json::array();
    for (const int bandCount : {1, 3, 10})
        cases.push_back({{"bands", bandCount},
                         {"hann", windowFactors(ShWindow::hann, bandCount)},
                         {"lanczos", windowFactors(ShWindow::lanczos, bandCount)}});
    return cases;
}

Json writeDeringing() {
    Json cases = Json::array();
    for (const int bandCount : {2, 3, 5, 10}) {
        const Lighting sun = sunLighting(drawDirection(), 0.1, bandCount);
        for (const Lighting& lighting :
             {sun, add(scale(sun, Vec3d(1.0, 0.8, 0.5)), drawLighting(bandCount))})
            cases.push_back(
                {{"lighting", toJson(lighting)},
                 {"radiance", deringingFactors(lighting)},
                 {"irradiance", deringingFactors(lighting, {NonNegative::irradiance})}});
    }
    return cases;
}

Json writeSuns() {
    Json cases = Json::array();
    for (const double angleDegrees : {0.0, 0.53, 10.0, 90.0, 200.0}) {
        const double azimuth = std::numbers::pi * drawNumber();
        const double elevation = 0.5 * std::numbers::pi * drawNumber();
        const Vec3d direction(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                              std::cos(elevation) * std::sin(azimuth));
        const double halfAngleRadians = angleDegrees * std::numbers::pi / 360.0;
        cases.push_back(
            {{"azimuthDegrees", azimuth * 180.0 / std::numbers::pi},
             {"elevationDegrees", elevation * 180.0 / std::numbers::pi},
             {"angleDegrees", angleDegrees},
             {"lighting", toJson(sunLighting(direction, halfAngleRadians, kMaxBandCount))}});
    }
    return cases;
}

Json writeProjections() {
    Json cases = Json::array();
    for (const auto& [width, height, bandCount] :
         {std::tuple{16, 8, 10}, std::tuple{7, 5, 4}, std::tuple{1, 1, 3}}) {
        Image image(width, height);
        Json texels = Json::array();
        for (Vec3f& pixel : image.pixels)
            for (int channel = 0; channel < 3; ++channel) {
                pixel[channel] = static_cast<float>(2.0 + 2.0 * drawNumber());
                texels.push_back(pixel[channel]);
            }
        cases.push_back({{"width", width},
                         {"height", height},
                         {"texels", texels},
                         {"lighting", toJson(projectLatLong(image, bandCount))}});
    }
    return cases;
}

Json writeRelitAssets(int pathCount, char** paths) {
    Json cases = Json::array();
    for (int k = 0; k < pathCount; ++k) {
        const Asset asset = readAsset(paths[k]);
        const Lighting lighting = drawLighting(asset.transfer.bandCount);
        Json layers = Json::object();
        for (const CompressedLayer& layer : asset.transfer.layers)
            layers[std::string(transportName(layer.transport))] =
                test::relightLayer(asset.transfer, layer, lighting);
        cases.push_back({{"file", std::filesystem::path(paths[k]).filename()},
                         {"lighting", toJson(lighting)},
                         {"layers", layers}});
    }
    return cases;
}

/// A Radiance file and its light.
Json writeRadiancePictures() {
    constexpr int kWidth = 7;
    constexpr int kHeight = 4;
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 7\n";
    const std::span<const std::byte> text = std::as_bytes(std::span(header));
    std::vector<std::byte> file(text.begin(), text.end());
    for (int k = 0; k < kWidth * kHeight; ++k) {
        for (int channel = 0; channel < 3; ++channel)
            file.push_back(std::byte(random32() % 256));
        file.push_back(std::byte(126 + random32() % 6));
    }
    const Image image = decodeRadianceHdr(file, "vectors.hdr", {});
    return {{{"file", test::encodeBase64(file)}, {"lighting", toJson(projectLatLong(image, 4))}}};
}

/// An asset with textures, and pictures of it.
Json writeShownSurface() {
    const std::vector<std::byte> file = test::makeShownAsset();
    Asset asset = decodeAsset(file, "shown.prt.glb");
    decodeTextures(asset.scene);
    Lighting lighting(asset.transfer.bandCount);  // so bright that little is below 0
    for (Vec3d& coefficient : lighting.coefficients)
        coefficient = Vec3d(9.0, 8.0, 7.0) + 2.0 * drawDirection();
    Json pictures = Json::object();
    for (const CompressedLayer& layer : asset.transfer.layers) {
        Json numbers = Json::array();
        for (const Vec3f& pixel : test::seeSurface(asset, layer, lighting))
            for (int channel = 0; channel < 3; ++channel)
                numbers.push_back(std::round(1.0e6 * pixel[channel]) / 1.0e6);
        pictures[std::string(transportName(layer.transport))] = numbers;
    }
    return {{{"file", test::encodeBase64(file)},
             {"size", test::kShownSize},
             {"metres", test::kShownMetres},
             {"lighting", toJson(lighting)},
             {"pictures", pictures}}};
}

}  // namespace

int main(int argumentCount, char** arguments) try {
    const Json vectors = {{"bases", writeBases()},
                          {"rotations", writeRotations()},
                          {"windows", writeWindows()},
                          {"deringing", writeDeringing()},
                          {"suns", writeSuns()},
                          {"projections", writeProjections()},
                          {"assets", writeRelitAssets(argumentCount - 1, arguments + 1)},
                          {"radiancePictures", writeRadiancePictures()},
                          {"shownSurfaces", writeShownSurface()}};
    for (const char* separator = "{\n"; const auto& [name, cases] : vectors.items()) {
        std::cout << separator << '"' << name << "\": [\n";
        for (const char* comma = ""; const Json& item : cases) {
            std::cout << comma << item.dump();
            comma = ",\n";
        }
        std::cout << "\n]";
        separator = ",\n";
    }
    std::cout << "\n}\n";
    return std::cout ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "write_web_vectors: %s\n", error.what());
    return 1;
}
