// By hand rather than by tinyobjloader, whose number parser takes what it cannot read ("nan", a
// missing coordinate, a word) for 0 and so hides the errors that a bake must report.

#include "prt/io/obj_parser.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "prt/base/error.h"
#include "prt/io/text_parsing.h"

namespace prt {
namespace {

const Vec3f kWhite(1.0f);

class ObjParser {
  public:
    ObjParser(std::string_view text, const std::string& name) : lines_(text), name_(name) {
        geometry_.materialNames.emplace_back();
    }

    ObjGeometry parse() {
        std::string joined;
        while (const std::optional<std::string_view> line = lines_.next()) {
            // A backslash at its end continues a line on the next.
            if (line->ends_with('\\')) {
                joined.append(line->substr(0, line->size() - 1)) += ' ';
            } else if (joined.empty()) {
                parseStatement(*line);
            } else {
                parseStatement(joined.append(*line));
                joined.clear();
            }
        }
        parseStatement(joined);
        checkIndices();
        if (!geometry_.colors.empty()) geometry_.colors.resize(geometry_.positions.size(), kWhite);
        return std::move(geometry_);
    }

  private:
    [[noreturn]] void fail(std::size_t lineNumber, const std::string& what) const {
        throw Error(ErrorCode::malformed, "line " + std::to_string(lineNumber) + " has " + what,
                    name_);
    }
    [[noreturn]] void fail(const std::string& what) const { fail(lines_.lineNumber(), what); }

    void parseStatement(std::string_view line) {
        const std::string_view keyword = takeWord(line);
        const std::string_view numbers = line.substr(0, line.find('#'));
        if (keyword == "v") {
            parsePosition(numbers);
        } else if (keyword == "vt") {
            parseUv(numbers);
        } else if (keyword == "vn") {
            parseNormal(numbers);
        } else if (keyword == "f") {
            parseFace(numbers);
        } else if (keyword == "usemtl") {
            useMaterial(std::string(trim(line)));
        } else if (keyword == "mtllib") {
            geometry_.libraryNames.emplace_back(trim(line));
        }
    }

    float parseFinite(std::string_view word, const char* what) const {
        const std::optional<float> value = parseFiniteFloat(word);
        if (!value) fail(std::string(what) + " that is not made of finite numbers");
        return *value;
    }

    /// `x y z [w]` or `x y z r g b`.
    void parsePosition(std::string_view words) {
        Vec3f position(0.0f), color = kWhite;
        for (int axis = 0; axis < 3; ++axis)
            position[axis] = parseFinite(takeWord(words), "a position");
        geometry_.positions.push_back(position);

        std::string_view colorWords = words;
        takeWord(words), takeWord(words);
        if (takeWord(words).empty()) return;
        for (int channel = 0; channel < 3; ++channel)
            color[channel] = std::clamp(parseFinite(takeWord(colorWords), "a colour"), 0.0f, 1.0f);
        geometry_.colors.resize(geometry_.positions.size() - 1, kWhite);
        geometry_.colors.push_back(color);
    }

    void parseUv(std::string_view words) {
        const float u = parseFinite(takeWord(words), "a texture coordinate");
        const std::string_view v = takeWord(words);
        geometry_.uvs.emplace_back(u, v.empty() ? 0.0f : parseFinite(v, "a texture coordinate"));
    }

    void parseNormal(std::string_view words) {
        Vec3f normal(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = takeWord(words);
            if (!parseNumber<double>(word)) fail("a normal that is not made of numbers");
            // Exporters write the normals of triangles without area as "nan".
            normal[axis] = parseFiniteFloat(word).value_or(0.0f);
        }
        geometry_.normals.push_back(normal);
    }

    void parseFace(std::string_view words) {
        const std::size_t firstCorner = geometry_.corners.size();
        for (std::string_view word = takeWord(words); !word.empty(); word = takeWord(words))
            geometry_.corners.push_back(parseCorner(word));
        const std::size_t cornerCount = geometry_.corners.size() - firstCorner;
        if (cornerCount < 3) {
            geometry_.corners.resize(firstCorner);
            ++geometry_.degenerateFaceCount;
            return;
        }
        geometry_.faces.push_back({firstCorner, cornerCount, material_, lines_.lineNumber()});
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    ObjCorner parseCorner(std::string_view word) const {
        const auto takeField = [&] {
            const std::string_view field = word.substr(0, word.find('/'));
            word.remove_prefix(std::min(field.size() + 1, word.size()));
            return field;
        };
        ObjCorner corner;
        corner.position = parseIndex(takeField(), geometry_.positions.size());
        if (!word.empty()) corner.uv = parseOptionalIndex(takeField(), geometry_.uvs.size());
        if (!word.empty())
            corner.normal = parseOptionalIndex(takeField(), geometry_.normals.size());
        if (!word.empty()) fail("a corner with more than three indices");
        return corner;
    }

    std::uint32_t parseOptionalIndex(std::string_view field, std::size_t countSoFar) const {
        // Some exporters write 0 for none.
        return field.empty() || field == "0" ? kObjNone : parseIndex(field, countSoFar);
    }

    /// Turns an index from 1, or a negative one from the last so far, into one from 0.
    std::uint32_t parseIndex(std::string_view field, std::size_t countSoFar) const {
        const std::optional<std::int64_t> index = parseNumber<std::int64_t>(field);
        if (!index) fail("a corner whose index is not a number");
        if (*index == 0) fail("a corner with the index 0, but they count from 1");
        const std::int64_t fromZero =
            *index > 0 ? *index - 1 : static_cast<std::int64_t>(countSoFar) + *index;
        if (fromZero < 0 || fromZero >= std::int64_t(kObjNone))
            fail("a corner with the index " + std::string(field) + ", which is out of range");
        return static_cast<std::uint32_t>(fromZero);
    }

    void useMaterial(std::string material) {
        const auto [entry, isNew] =
            materialByName_.try_emplace(std::move(material), geometry_.materialNames.size());
        if (isNew) geometry_.materialNames.push_back(entry->first);
        material_ = entry->second;
    }

    /// At the end, because a face may stand before what it refers to.
    void checkIndices() const {
        for (const ObjFace& face : geometry_.faces)
            for (std::size_t i = 0; i < face.cornerCount; ++i) {
                const ObjCorner& corner = geometry_.corners[face.firstCorner + i];
                checkIndex(face, corner.position, geometry_.positions.size(), "position");
                if (corner.uv != kObjNone)
                    checkIndex(face, corner.uv, geometry_.uvs.size(), "texture coordinate");
                if (corner.normal != kObjNone)
                    checkIndex(face, corner.normal, geometry_.normals.size(), "normal");
            }
    }

    void checkIndex(const ObjFace& face, std::uint32_t index, std::size_t count,
                    const char* what) const {
        if (index >= count)
            fail(face.lineNumber, std::string("a face with ") + what + " " +
                                      std::to_string(std::size_t(index) + 1) + " of " +
                                      std::to_string(count));
    }

    LineReader lines_;
    const std::string& name_;
    ObjGeometry geometry_;
    std::unordered_map<std::string, std::size_t> materialByName_ = {{"", 0}};
    std::size_t material_ = 0;
};

}  // namespace

ObjGeometry parseObj(std::string_view text, const std::string& name) {
    return ObjParser(text, name).parse();
}

}  // namespace prt
