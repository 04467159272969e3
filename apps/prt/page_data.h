#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prt/image/image.h"
#include "prt/light/lighting.h"
#include "prt/scene/scene.h"

namespace prt::cli {

/// An asset of a page.
struct PageAsset {
    std::string name;
    Camera camera;                ///< from where it is seen at first
    std::vector<std::byte> file;  ///< a binary glTF that names no other file
};

/// A light of a page.
struct PageLight {
    std::string name;
    Lighting lighting;
    Image picture;  ///< to be seen behind the scene: lat-long, linear radiance
};

/// The page of `prt web`: assets and lights where kPageDataMark stands in the template, in the form
/// that web/page/src/page_data.ts reads.
///
/// The page is as large as the template and four thirds of the files: their bytes stand in it as
/// base64 [RFC 4648]. Pictures stand in it so too, as half floats; what a half cannot hold becomes
/// the nearest radiance that it can.
std::string fillPage(std::string_view pageTemplate, std::span<const PageAsset> assets,
                     std::span<const PageLight> lights);

/// Names in which equal ones have a number from the second on: "lamp", "lamp 2".
std::vector<std::string> tellApart(std::vector<std::string> names);

}  // namespace prt::cli
