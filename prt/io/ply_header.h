#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace prt {

enum class PlyFormat { ascii, littleEndian, bigEndian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t plyTypeBytes(PlyType type);
bool isPlyInteger(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;  ///< of the value, or of each item of a list
    bool isList = false;
    PlyType countType = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t byteCount = 0;  ///< where the body starts
};

/// Reads the header of a PLY file [Turk94]. Lines may end in \n, \r\n or \r.
///
/// @param name    how to call it in an error
/// @throws Error  malformed or unsupported
PlyHeader parsePlyHeader(std::string_view file, const std::string& name);

}  // namespace prt
