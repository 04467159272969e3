#include "apps/viewer/shown_object.h"

#include <utility>

#include "prt/base/assert.h"
#include "prt/parallel/parallel_for.h"
#include "prt/render/signed_radiance.h"

namespace prt::viewer {

using cli::ShownTransport;

ShownTransport chooseTransport(const Pane& pane, const CompressedTransfer& transfer) {
    if (pane.transport && cli::isAvailable(transfer, *pane.transport)) return *pane.transport;
    return cli::fullestShown(transfer);
}

ShownObject::ShownObject(std::shared_ptr<const Asset> asset, std::string path,
                         const RelightingOptions& options)
    : asset_(std::move(asset)), path_(std::move(path)), options_(options), scene_(asset_->scene) {}

bool ShownObject::isUpToDate(const Relit& relit, const Pane& pane, const Lighting& lighting,
                             const Vec3f& eye) const {
    if (!relit.onCard && !relit.uploaded) return false;
    const ShownTransport shown = chooseTransport(pane, asset_->transfer);
    // Where surfaces are taken for diffuse, the eye changes nothing.
    return relit.pane == pane && relit.coefficients == lighting.coefficients &&
           (!cli::isGlossy(shown) || relit.eye == eye);
}

const GpuRadiance& ShownObject::relight(std::size_t paneIndex, const Pane& pane,
                                        const Lighting& lighting, const Vec3f& eye) {
    PRT_ASSERT(paneIndex < kPaneCount, "a pane of the view");
    Relit& relit = relit_[paneIndex];
    if (!isUpToDate(relit, pane, lighting, eye)) {
        const ShownTransport shown = chooseTransport(pane, asset_->transfer);
        const bool isNew = chooseTransport(relit.pane, asset_->transfer) != shown;
        const bool hasVectors =
            !cli::isGlossy(shown) && cli::findShownLayer(asset_->transfer, shown);
        relit.pane = pane;
        if (options_.onCard && hasVectors && pane.content != PaneContent::coefficient)
            relightOnCard(relit, shown, isNew, lighting);
        else
            relightHere(relit, shown, lighting, eye);
        relit.coefficients = lighting.coefficients;
        relit.eye = eye;
    }
    if (relit.onCard) return *relit.onCard;
    return *relit.uploaded;
}

void ShownObject::relightOnCard(Relit& relit, ShownTransport shown, bool isNew,
                                const Lighting& lighting) const {
    relit.uploaded.reset();
    if (isNew || !relit.onCard) {
        relit.onCard.reset();  // before there are two
        relit.onCard.emplace(asset_->transfer,
                             cli::findShownLayer(asset_->transfer, shown)->transport);
    }
    relit.onCard->relight(lighting);
}

void ShownObject::relightHere(Relit& relit, ShownTransport shown, const Lighting& lighting,
                              const Vec3f& eye) const {
    relit.onCard.reset();
    if (!relit.relighter)
        relit.relighter.emplace(*asset_, path_, cli::GivenBrdfs(), options_.threadCount);
    if (!relit.uploaded) relit.uploaded.emplace(scene_.vertexCount());
    if (relit.pane.content == PaneContent::coefficient) {
        relit.uploaded->upload(showSignedRadiance(relit.relighter->relight(shown, lighting, eye)));
        return;
    }
    if (cli::isGlossy(shown)) {
        relit.uploaded->upload(relit.relighter->relight(shown, lighting, eye));
        return;
    }
    relit.vertexRadiance.resize(scene_.vertexCount());
    const Relighter& relighter = relit.relighter->vectorRelighter(shown);
    parallelFor(relit.vertexRadiance.size(), {options_.threadCount, kRelightPartSize},
                [&](std::size_t begin, std::size_t end) {
                    relighter.relight(lighting, begin,
                                      std::span(relit.vertexRadiance).subspan(begin, end - begin));
                });
    relit.uploaded->upload(relit.vertexRadiance);
}

}  // namespace prt::viewer
