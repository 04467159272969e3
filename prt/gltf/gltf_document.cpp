#include "prt/gltf/gltf_document.h"

#include <new>
#include <utility>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/gltf/accessor.h"
#include "prt/gltf/flatten.h"
#include "prt/gltf/model.h"

namespace prt {
namespace {

/// Calls `work` and gives every Error that it throws the file's name,
/// where it does not name another.
template <class Work>
auto namingFile(const std::string& file, Work work) {
    try {
        return work();
    } catch (const Error& error) {
        if (!error.where().empty()) throw;
        throw Error(error.code(), error.what(), file, error.hint());
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::outOfMemory, "does not fit in memory", file);
    }
}

std::optional<std::string> findExtension(const gltf::JsonCursor& object, std::string_view name) {
    const std::optional<gltf::JsonCursor> extensions = object.find("extensions");
    if (!extensions) return std::nullopt;
    const auto extension = extensions->find(std::string(name).c_str());
    if (!extension) return std::nullopt;
    return extension->dump();
}

}  // namespace

struct GltfDocument::Content {
    Content(std::string name, std::vector<std::byte> bytes, const std::filesystem::path& folder,
            const GltfLimits& limits)
        : file(std::move(name)), model(std::move(bytes), folder, limits) {}

    const gltf::Primitive& primitive(const PrimitiveId& id) const {
        PRT_ASSERT(
            id.mesh < model.meshes.size() && id.primitive < model.meshes[id.mesh].primitives.size(),
            "the primitive is one of the file");
        return model.meshes[id.mesh].primitives[id.primitive];
    }

    const gltf::Accessor& accessor(std::size_t index) const {
        PRT_ASSERT(index < model.accessors.size(), "the accessor is one of the file");
        return model.accessors[index];
    }

    std::string file;
    gltf::Model model;
};

GltfDocument::GltfDocument(const std::filesystem::path& path, const GltfLimits& limits)
    : content_(namingFile(path.string(), [&] {
          return std::make_unique<Content>(path.string(), readFile(path, limits.maxFileBytes),
                                           path.parent_path(), limits);
      })) {}

GltfDocument::GltfDocument(std::vector<std::byte> file, const std::filesystem::path& folder,
                           const GltfLimits& limits)
    : content_(namingFile(
          "", [&] { return std::make_unique<Content>("", std::move(file), folder, limits); })) {}

GltfDocument::~GltfDocument() = default;

FlattenedGltf GltfDocument::flatten() const {
    return namingFile(content_->file, [&] { return gltf::flattenModel(content_->model); });
}

std::optional<std::string> GltfDocument::rootExtension(std::string_view name) const {
    return namingFile(content_->file, [&] { return findExtension(content_->model.root(), name); });
}

std::optional<std::string> GltfDocument::primitiveExtension(const PrimitiveId& id,
                                                            std::string_view name) const {
    content_->primitive(id);
    return namingFile(content_->file, [&] {
        const gltf::JsonCursor mesh = content_->model.root().at("meshes")[id.mesh];
        return findExtension(mesh.at("primitives")[id.primitive], name);
    });
}

std::optional<std::size_t> GltfDocument::attributeAccessor(const PrimitiveId& id,
                                                           std::string_view semantic) const {
    return content_->primitive(id).findAttribute(semantic);
}

AccessorInfo GltfDocument::describeAccessor(std::size_t accessor) const {
    return content_->accessor(accessor).info;
}

std::vector<float> GltfDocument::readFloats(std::size_t index) const {
    const gltf::Accessor& accessor = content_->accessor(index);
    return namingFile(content_->file, [&] {
        std::vector<float> numbers(accessor.info.count *
                                   static_cast<std::size_t>(accessor.info.componentCount));
        gltf::readNumbers(accessor, numbers);
        gltf::checkFinite(numbers, accessor.place);
        return numbers;
    });
}

std::vector<std::byte> GltfDocument::readRaw(std::size_t index) const {
    const gltf::Accessor& accessor = content_->accessor(index);
    return namingFile(content_->file, [&] { return gltf::readComponents(accessor); });
}

std::size_t GltfDocument::accessorCount() const {
    return content_->model.accessors.size();
}

std::size_t GltfDocument::bufferViewCount() const {
    return content_->model.buffers.views.size();
}

std::span<const std::byte> GltfDocument::bufferViewBytes(std::size_t bufferView) const {
    PRT_ASSERT(bufferView < bufferViewCount(), "the buffer view is one of the file");
    return content_->model.buffers.views[bufferView].bytes;
}

std::span<const std::byte> GltfDocument::storedViewBytes(std::size_t bufferView) const {
    PRT_ASSERT(bufferView < bufferViewCount(), "the buffer view is one of the file");
    return content_->model.buffers.views[bufferView].storedBytes;
}

std::size_t GltfDocument::trailingByteCount() const {
    return content_->model.file.trailingByteCount;
}

}  // namespace prt
