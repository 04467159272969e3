#include "prt/gltf/materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "prt/base/error.h"

namespace prt::gltf {
namespace {

// The names that glTF borrows from OpenGL.
constexpr std::size_t kNearest = 9728;
constexpr std::size_t kLinear = 9729;
constexpr std::size_t kClampToEdge = 33071;
constexpr std::size_t kMirroredRepeat = 33648;
constexpr std::size_t kRepeat = 10497;

struct Sampler {
    TextureWrap wrapU = TextureWrap::repeat;
    TextureWrap wrapV = TextureWrap::repeat;
    TextureFilter filter = TextureFilter::linear;
};

/// A texture of the file; without an image where only an extension names one.
struct Texture {
    Sampler sampler;
    std::optional<std::size_t> image;
};

/// A texture as a material binds it, before UV sets are shared out.
struct Binding {
    TextureUse use;
    UvSource uvSource;
};

TextureWrap parseWrap(const JsonCursor& sampler, const char* key) {
    const std::optional<JsonCursor> value = sampler.find(key);
    if (!value) return TextureWrap::repeat;
    switch (value->toCount()) {
        case kRepeat:
            return TextureWrap::repeat;
        case kMirroredRepeat:
            return TextureWrap::mirroredRepeat;
        case kClampToEdge:
            return TextureWrap::clampToEdge;
        default:
            value->reject("is not a wrapping mode");
    }
}

TextureFilter parseFilter(const JsonCursor& sampler) {
    const std::optional<JsonCursor> value = sampler.find("magFilter");
    if (!value || value->toCount() == kLinear) return TextureFilter::linear;
    if (value->toCount() != kNearest) value->reject("is not a filter");
    return TextureFilter::nearest;
}

Sampler parseSampler(const JsonCursor& value) {
    return {parseWrap(value, "wrapS"), parseWrap(value, "wrapT"), parseFilter(value)};
}

std::vector<Texture> parseTextures(const JsonCursor& root) {
    const std::vector<Sampler> samplers = parseEach(root, "samplers", parseSampler);
    const std::size_t imageCount = countElements(root, "images");
    return parseEach(root, "textures", [&](const JsonCursor& value) {
        Texture texture;
        if (const auto sampler = value.findIndex("sampler", samplers.size(), "samplers"))
            texture.sampler = samplers[*sampler];
        texture.image = value.findIndex("source", imageCount, "images");
        return texture;
    });
}

/// The member of an extension of an object, if it has that extension.
std::optional<JsonCursor> findExtension(const JsonCursor& object, const char* name) {
    const std::optional<JsonCursor> extensions = object.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

/// offset + rotation · scale · uv, where a positive angle turns UVs counter-clockwise as the image
/// is seen, v downwards [KHR_texture_transform].
UvSource parseUvSource(const JsonCursor& textureInfo) {
    UvSource source{textureInfo.countOr("texCoord", 0)};
    const auto transform = findExtension(textureInfo, "KHR_texture_transform");
    if (!transform) return source;
    const std::array<double, 2> scale = transform->numbersOr<2>("scale", {1.0, 1.0});
    const double angle = transform->numberOr("rotation", 0.0);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    source.texCoord = transform->countOr("texCoord", source.texCoord);
    source.linear = {c * scale[0], s * scale[1], -s * scale[0], c * scale[1]};
    source.offset = transform->numbersOr<2>("offset", {0.0, 0.0});
    return source;
}

/// Reads materials, one after the other, and gathers the images that they use.
class MaterialParser {
  public:
    MaterialParser(const JsonCursor& root, Warnings& warnings)
        : textures_(parseTextures(root)), warnings_(warnings) {}

    MaterialRecord parse(const JsonCursor& value);
    std::vector<std::size_t> takeImages() { return std::move(images_); }

  private:
    double clampedNumber(const JsonCursor& object, const char* key, double fallback, double high);
    template <std::size_t N>
    std::array<double, N> clampedNumbers(const JsonCursor& object, const char* key,
                                         double fallback);
    void parseMetallicRoughness(const JsonCursor& pbr, Material& material);
    void parseAlpha(const JsonCursor& value, Material& material);
    std::optional<Binding> parseTextureInfo(const JsonCursor& object, const char* key);
    std::size_t useImage(std::size_t fileImage);

    std::vector<Texture> textures_;
    Warnings& warnings_;
    std::vector<std::size_t> images_;
    std::map<std::size_t, std::size_t> sceneImageOf_;
};

double MaterialParser::clampedNumber(const JsonCursor& object, const char* key, double fallback,
                                     double high) {
    const double number = object.numberOr(key, fallback);
    if (number < 0.0 || number > high)
        warnings_.add(object.place() + "." + key + " is out of range and was clamped");
    return std::clamp(number, 0.0, high);
}

template <std::size_t N>
std::array<double, N> MaterialParser::clampedNumbers(const JsonCursor& object, const char* key,
                                                     double fallback) {
    std::array<double, N> numbers;
    numbers.fill(fallback);
    numbers = object.numbersOr<N>(key, numbers);
    for (double& number : numbers) {
        if (number < 0.0 || number > 1.0)
            warnings_.add(object.place() + "." + key + " is out of range and was clamped");
        number = std::clamp(number, 0.0, 1.0);
    }
    return numbers;
}

std::size_t MaterialParser::useImage(std::size_t fileImage) {
    const auto [entry, isNew] = sceneImageOf_.try_emplace(fileImage, images_.size());
    if (isNew) images_.push_back(fileImage);
    return entry->second;
}

std::optional<Binding> MaterialParser::parseTextureInfo(const JsonCursor& object, const char* key) {
    const std::optional<JsonCursor> info = object.find(key);
    if (!info) return std::nullopt;
    const Texture& texture = textures_[info->at("index").toIndex(textures_.size(), "textures")];
    if (!texture.image) {
        warnings_.add(info->place() + " has no PNG or JPEG image and was left out");
        return std::nullopt;
    }
    Binding binding;
    binding.use.image = useImage(*texture.image);
    binding.use.wrapU = texture.sampler.wrapU;
    binding.use.wrapV = texture.sampler.wrapV;
    binding.use.filter = texture.sampler.filter;
    binding.uvSource = parseUvSource(*info);
    return binding;
}

void MaterialParser::parseMetallicRoughness(const JsonCursor& pbr, Material& material) {
    const auto color = clampedNumbers<4>(pbr, "baseColorFactor", 1.0);
    for (int i = 0; i < 4; ++i)
        material.baseColorFactor[i] = static_cast<float>(color[static_cast<std::size_t>(i)]);
    material.metallicFactor = static_cast<float>(clampedNumber(pbr, "metallicFactor", 1.0, 1.0));
    material.roughnessFactor = static_cast<float>(clampedNumber(pbr, "roughnessFactor", 1.0, 1.0));
}

void MaterialParser::parseAlpha(const JsonCursor& value, Material& material) {
    const std::string mode = value.stringOr("alphaMode", "OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
        value.at("alphaMode").reject("must be OPAQUE, MASK or BLEND");
    if (mode == "MASK") material.alphaMode = AlphaMode::mask;
    if (mode == "BLEND") material.alphaMode = AlphaMode::blend;
    // A cut-off above 1 is allowed: it hides the surface whole.
    constexpr double kHighestCutoff = std::numeric_limits<float>::max();
    material.alphaCutoff =
        static_cast<float>(clampedNumber(value, "alphaCutoff", 0.5, kHighestCutoff));
}

/// Gives the bound texture one of the two UV sets: one that already
/// is what it needs, or a free one. False where there is neither.
bool assignUvSet(Binding& binding, MaterialRecord& record, std::array<bool, 2>& isTaken) {
    std::size_t set = std::min<std::size_t>(binding.uvSource.texCoord, 1);
    if (record.uvSources[1 - set] == binding.uvSource) set = 1 - set;
    if (isTaken[set] && record.uvSources[set] != binding.uvSource) set = 1 - set;
    if (isTaken[set] && record.uvSources[set] != binding.uvSource) return false;
    record.uvSources[set] = binding.uvSource;
    isTaken[set] = true;
    binding.use.uvSet = static_cast<int>(set);
    return true;
}

MaterialRecord MaterialParser::parse(const JsonCursor& value) {
    MaterialRecord record;
    Material& material = record.material;
    material = defaultMaterial();
    material.name = value.stringOr("name", "");
    material.doubleSided = value.boolOr("doubleSided", false);
    parseAlpha(value, material);
    const auto emissive = clampedNumbers<3>(value, "emissiveFactor", 0.0);
    material.emissiveFactor = Vec3f(Vec3d(emissive[0], emissive[1], emissive[2]));
    if (findExtension(value, "KHR_materials_emissive_strength"))
        warnings_.add(value.place() + " has an emissive strength, which was left out");

    // A third way to the UVs finds both sets taken, so the texture that matters least comes last.
    std::array<bool, 2> isTaken{};
    const auto bindTexture = [&](const JsonCursor& object, const char* key) {
        std::optional<Binding> binding = parseTextureInfo(object, key);
        if (binding && !assignUvSet(*binding, record, isTaken)) {
            warnings_.add(object.place() + "." + key +
                          " needs a third set of texture coordinates and was left out");
            binding.reset();
        }
        return binding ? std::optional(binding->use) : std::nullopt;
    };
    const std::optional<JsonCursor> pbr = value.find("pbrMetallicRoughness");
    if (pbr) {
        parseMetallicRoughness(*pbr, material);
        material.baseColorTexture = bindTexture(*pbr, "baseColorTexture");
    }
    material.emissiveTexture = bindTexture(value, "emissiveTexture");
    if (pbr) material.metallicRoughnessTexture = bindTexture(*pbr, "metallicRoughnessTexture");
    return record;
}

/// The media type by the file's first bytes; what the JSON says of it is not needed.
const char* sniffMimeType(std::span<const std::byte> encoded) {
    const auto startsWith = [&](std::initializer_list<unsigned> signature) {
        return encoded.size() >= signature.size() &&
               std::equal(
                   signature.begin(), signature.end(), encoded.begin(),
                   [](unsigned a, std::byte b) { return a == std::to_integer<unsigned>(b); });
    };
    if (startsWith({0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'})) return "image/png";
    return startsWith({0xFF, 0xD8, 0xFF}) ? "image/jpeg" : nullptr;
}

TextureImage loadImage(const JsonCursor& value, const std::vector<BufferView>& views,
                       ResourceLoader& loader) {
    TextureImage image;
    image.name = value.stringOr("name", "");
    const auto view = value.findIndex("bufferView", views.size(), "buffer views");
    const std::optional<JsonCursor> uri = value.find("uri");
    if (view.has_value() == uri.has_value()) value.reject("must have a URI or a buffer view");
    if (view && views[*view].bytes.empty()) value.reject("lies in a buffer without bytes");
    if (view)
        image.encoded.assign(views[*view].bytes.begin(), views[*view].bytes.end());
    else
        image.encoded = loader.load(*uri);

    const char* mimeType = sniffMimeType(image.encoded);
    if (mimeType == nullptr)
        throw Error(ErrorCode::unsupported, value.place() + " is neither a PNG nor a JPEG image");
    image.mimeType = mimeType;
    return image;
}

}  // namespace

Material defaultMaterial() {
    Material material;
    material.metallicFactor = 1.0f;
    return material;
}

MaterialTable parseMaterials(const JsonCursor& root, Warnings& warnings) {
    MaterialParser parser(root, warnings);
    MaterialTable table;
    table.records =
        parseEach(root, "materials", [&](const JsonCursor& value) { return parser.parse(value); });
    table.images = parser.takeImages();
    return table;
}

std::vector<TextureImage> loadImages(const JsonCursor& root, const std::vector<std::size_t>& images,
                                     const std::vector<BufferView>& views, ResourceLoader& loader) {
    std::vector<TextureImage> loaded;
    loaded.reserve(images.size());
    for (const std::size_t image : images)
        loaded.push_back(loadImage(root.at("images")[image], views, loader));
    return loaded;
}

}  // namespace prt::gltf
