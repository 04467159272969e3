#pragma once

#include <string>

#include <fmt/format.h>

namespace prt::test {

/// One triangle as a .gltf, with a place for each thing that can be wrong in it.
struct TriangleGltf {
    std::string indices =
        "AAABAAIA";  ///< base64 of the 16-bit numbers 0 1 2, then two bytes of padding
    std::string positions =
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";  ///< (0,0,0) (1,0,0) (0,1,0)
    std::string nodes = R"([{"mesh": 0}])";
    std::string uri{};  ///< of the buffer; empty: the data above

    std::string text() const {
        const std::string data = "data:application/octet-stream;base64," + positions + indices;
        return fmt::format(
            R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": {},
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
"buffers": [{{"byteLength": 42, "uri": "{}"}}],
"bufferViews": [{{"buffer": 0, "byteOffset": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": 6}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
{{"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}}]}})",
            nodes, uri.empty() ? data : uri);
    }
};

}  // namespace prt::test
