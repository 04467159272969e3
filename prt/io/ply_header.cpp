#include "prt/io/ply_header.h"

#include <array>
#include <optional>
#include <utility>

#include "prt/base/error.h"
#include "prt/io/text_parsing.h"

namespace prt {
namespace {

std::optional<PlyType> parseType(std::string_view name) {
    // Each type has an older name and one that says its size.
    constexpr std::array<std::array<std::string_view, 2>, 8> kNames = {{{"char", "int8"},
                                                                        {"uchar", "uint8"},
                                                                        {"short", "int16"},
                                                                        {"ushort", "uint16"},
                                                                        {"int", "int32"},
                                                                        {"uint", "uint32"},
                                                                        {"float", "float32"},
                                                                        {"double", "float64"}}};
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<PlyType>(i);
    return std::nullopt;
}

class PlyHeaderParser {
  public:
    PlyHeaderParser(std::string_view file, const std::string& name)
        : file_(file), lines_(file), name_(name) {}

    PlyHeader parse() {
        if (trim(nextLine()) != "ply") fail("is not a PLY file");
        parseFormat(nextLine());
        while (parseStatement(nextLine())) {
        }
        header_.byteCount = file_.size() - lines_.rest().size();
        return std::move(header_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::malformed, what, name_);
    }
    [[noreturn]] void failLine(const std::string& what) const {
        fail("line " + std::to_string(lines_.lineNumber()) + " of the header has " + what);
    }

    std::string_view nextLine() {
        const std::optional<std::string_view> line = lines_.next();
        if (!line) fail("has a PLY header that ends too early");
        return *line;
    }

    void parseFormat(std::string_view line) {
        const std::string_view keyword = takeWord(line);
        if (keyword == "comment" || keyword == "obj_info") return parseFormat(nextLine());
        if (keyword != "format") failLine("no format");
        const std::string_view format = takeWord(line);
        if (format == "ascii") {
            header_.format = PlyFormat::ascii;
        } else if (format == "binary_little_endian") {
            header_.format = PlyFormat::littleEndian;
        } else if (format == "binary_big_endian") {
            header_.format = PlyFormat::bigEndian;
        } else {
            failLine("an unknown format");
        }
        if (takeWord(line) != "1.0")
            throw Error(ErrorCode::unsupported, "is not of PLY version 1.0", name_);
    }

    /// Returns whether the header goes on.
    bool parseStatement(std::string_view line) {
        const std::string_view keyword = takeWord(line);
        if (keyword == "end_header") return false;
        if (keyword == "element") {
            parseElement(line);
        } else if (keyword == "property") {
            parseProperty(line);
        } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
            failLine("an unknown statement");
        }
        return true;
    }

    void parseElement(std::string_view words) {
        const std::string_view name = takeWord(words);
        const std::optional<std::uint64_t> count = parseNumber<std::uint64_t>(takeWord(words));
        if (name.empty() || !count) failLine("an element without a name and a count");
        header_.elements.push_back({.name = std::string(name), .count = *count, .properties = {}});
    }

    void parseProperty(std::string_view words) {
        if (header_.elements.empty()) failLine("a property that belongs to no element");
        PlyProperty property;
        std::string_view type = takeWord(words);
        property.isList = type == "list";
        if (property.isList) {
            property.countType = requireType(takeWord(words));
            if (!isPlyInteger(property.countType)) failLine("a list whose length is no integer");
            type = takeWord(words);
        }
        property.type = requireType(type);
        property.name = std::string(takeWord(words));
        if (property.name.empty()) failLine("a property without a name");
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType requireType(std::string_view name) const {
        const std::optional<PlyType> type = parseType(name);
        if (!type) failLine("an unknown type");
        return *type;
    }

    std::string_view file_;
    LineReader lines_;
    const std::string& name_;
    PlyHeader header_;
};

}  // namespace

std::size_t plyTypeBytes(PlyType type) {
    constexpr std::array<std::size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
    return kBytes[static_cast<std::size_t>(type)];
}

bool isPlyInteger(PlyType type) {
    return type != PlyType::float32 && type != PlyType::float64;
}

PlyHeader parsePlyHeader(std::string_view file, const std::string& name) {
    return PlyHeaderParser(file, name).parse();
}

}  // namespace prt
