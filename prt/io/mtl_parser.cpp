#include "prt/io/mtl_parser.h"

#include <array>

#include "prt/base/error.h"
#include "prt/io/text_parsing.h"

namespace prt {
namespace {

/// An option of a texture statement and the most arguments it takes.
struct TextureOption {
    std::string_view name;
    int maxArgumentCount;
};
constexpr std::array<TextureOption, 13> kTextureOptions = {{{"-blendu", 1},
                                                            {"-blendv", 1},
                                                            {"-boost", 1},
                                                            {"-bm", 1},
                                                            {"-cc", 1},
                                                            {"-clamp", 1},
                                                            {"-imfchan", 1},
                                                            {"-mm", 2},
                                                            {"-o", 3},
                                                            {"-s", 3},
                                                            {"-t", 3},
                                                            {"-texres", 1},
                                                            {"-type", 1}}};

class MtlParser {
  public:
    MtlParser(std::string_view text, const std::string& name) : lines_(text), name_(name) {}

    std::vector<MtlMaterial> parse() {
        while (const std::optional<std::string_view> line = lines_.next())
            parseStatement(*line);
        return std::move(materials_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::malformed,
                    "line " + std::to_string(lines_.lineNumber()) + " has " + what, name_);
    }

    void parseStatement(std::string_view line) {
        const std::string_view keyword = takeWord(line);
        if (keyword == "newmtl") {
            materials_.emplace_back().name = trim(line);
        } else if (materials_.empty()) {
            // What stands before the first material belongs to none.
        } else if (keyword == "Kd") {
            materials_.back().diffuse = parseColor(line);
        } else if (keyword == "Ke") {
            materials_.back().emission = parseColor(line).value_or(Vec3f(0.0f));
        } else if (keyword == "map_Kd") {
            parseTexture(line, materials_.back());
        } else if (keyword == "d" || keyword == "Tr") {
            parseTransparency(keyword, line);
        } else if (keyword == "map_d") {
            materials_.back().isTransparent = true;
        }
    }

    /// `r [g b]`; nothing for the spectral and CIE forms.
    std::optional<Vec3f> parseColor(std::string_view words) const {
        std::string_view word = takeWord(words);
        if (word == "spectral" || word == "xyz") return std::nullopt;
        Vec3f color(0.0f);
        for (int channel = 0; channel < 3; ++channel) {
            const std::optional<float> value = parseFiniteFloat(word);
            if (!value || *value < 0.0f) fail("a colour that is not made of numbers from 0 up");
            color[channel] = *value;
            const std::string_view following = takeWord(words);
            if (channel == 0 && following.empty()) return Vec3f(*value);
            word = following;
        }
        return color;
    }

    void parseTransparency(std::string_view keyword, std::string_view words) {
        std::string_view word = takeWord(words);
        if (word == "-halo") word = takeWord(words);
        const std::optional<float> value = parseFiniteFloat(word);
        if (!value) fail("a transparency that is not a number");
        if (keyword == "d" ? *value < 1.0f : *value > 0.0f) materials_.back().isTransparent = true;
    }

    /// `[-option arguments …] file name`, where the name may hold blanks.
    static void parseTexture(std::string_view rest, MtlMaterial& material) {
        for (rest = trim(rest); rest.starts_with('-'); rest = trim(rest)) {
            const std::string_view option = takeWord(rest);
            const TextureOption* known = findOption(option);
            if (!known) break;
            for (int i = 0; i < known->maxArgumentCount; ++i) {
                std::string_view afterArgument = rest;
                const std::string_view argument = takeWord(afterArgument);
                // Only -o, -s and -t may have fewer arguments than the most,
                // and theirs are numbers.
                if (i > 0 && !parseNumber<double>(argument)) break;
                if (option == "-clamp") material.clampsTexture = argument == "on";
                rest = afterArgument;
            }
        }
        material.diffuseTexture = std::string(rest);
    }

    static const TextureOption* findOption(std::string_view name) {
        for (const TextureOption& option : kTextureOptions)
            if (option.name == name) return &option;
        return nullptr;
    }

    LineReader lines_;
    const std::string& name_;
    std::vector<MtlMaterial> materials_;
};

}  // namespace

std::vector<MtlMaterial> parseMtl(std::string_view text, const std::string& name) {
    return MtlParser(text, name).parse();
}

}  // namespace prt
