#include "apps/viewer/shown_object.h"

#include <utility>

#include "prt/base/assert.h"
#include "prt/relight/receiver_transfer.h"
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

const GpuRadiance& ShownObject::relight(std::size_t paneIndex, const Pane& pane,
                                        const Lighting& lighting, const Vec3f& eye) {
    PRT_ASSERT(paneIndex < kPaneCount, "a pane of the view");
    Relit& relit = relit_[paneIndex];
    const ShownTransport shown = chooseTransport(pane, asset_->transfer);
    const bool isSameLight =
        relit.radiance && relit.pane == pane && relit.coefficients == lighting.coefficients;
    // Where surfaces are taken for diffuse, the eye changes nothing.
    if (isSameLight && (!cli::isGlossy(shown) || relit.eye == eye)) return *relit.radiance;

    if (relit.shown != shown) {
        relit.vectorsOnCard.reset();
        relit.matricesOnCard.reset();
    }
    const bool isBaked = cli::findShownLayer(asset_->transfer, shown) != nullptr;
    relit.radiance = nullptr;
    relit.pane = pane;
    relit.shown = shown;
    relit.radiance = options_.onCard && isBaked && pane.content != PaneContent::coefficient
                         ? &relightOnCard(relit, shown, lighting, eye)
                         : &relightHere(relit, shown, lighting, eye);
    relit.coefficients = lighting.coefficients;
    relit.eye = eye;
    return *relit.radiance;
}

const GpuRadiance& ShownObject::relightOnCard(Relit& relit, ShownTransport shown,
                                              const Lighting& lighting, const Vec3f& eye) const {
    if (!cli::isGlossy(shown)) {
        if (!relit.vectorsOnCard)
            relit.vectorsOnCard.emplace(asset_->transfer,
                                        cli::findShownLayer(asset_->transfer, shown)->transport,
                                        options_.programs);
        relit.vectorsOnCard->relight(lighting);
        return *relit.vectorsOnCard;
    }
    if (!relit.matricesOnCard) {
        relit.receivedOnCard.clear();
        relit.matricesOnCard.emplace(
            relighterOf(relit).makeGlossyRelighter<GpuGlossyRelighter>(shown, options_.programs));
    }
    if (relit.receivedOnCard != lighting.coefficients) {
        relit.matricesOnCard->relight(lighting);
        relit.receivedOnCard = lighting.coefficients;
    }
    relit.matricesOnCard->lookFrom(eye);
    return *relit.matricesOnCard;
}

const GpuRadiance& ShownObject::relightHere(Relit& relit, ShownTransport shown,
                                            const Lighting& lighting, const Vec3f& eye) const {
    cli::AssetRelighter& relighter = relighterOf(relit);
    if (!relit.uploaded) relit.uploaded.emplace(scene_.vertexCount(), options_.programs);
    if (relit.pane.content == PaneContent::coefficient) {
        relit.uploaded->upload(showSignedRadiance(relighter.relight(shown, lighting, eye)));
    } else if (cli::isGlossy(shown)) {
        relit.uploaded->upload(relighter.relight(shown, lighting, eye));
    } else {
        relit.vertexRadiance.resize(scene_.vertexCount());
        relighter.relightVectors(shown, lighting, relit.vertexRadiance);
        relit.uploaded->upload(relit.vertexRadiance);
    }
    return *relit.uploaded;
}

cli::AssetRelighter& ShownObject::relighterOf(Relit& relit) const {
    if (!relit.relighter)
        relit.relighter.emplace(*asset_, path_, cli::GivenBrdfs(), options_.threadCount,
                                options_.tables);
    return *relit.relighter;
}

std::optional<Lighting> ShownObject::expandVertex(std::size_t paneIndex, ShownTransport shown,
                                                  std::size_t vertex, const Vec3f& eye) {
    const CompressedLayer* layer = cli::findShownLayer(asset_->transfer, shown);
    if (!layer) return std::nullopt;
    const std::size_t receiver = asset_->transfer.receiverOfVertex[vertex];
    if (!cli::isGlossy(shown)) return expandReceiver(asset_->transfer, layer->transport, receiver);
    return expandReceiver(relighterOf(relit_[paneIndex]).glossyRelighter(shown), eye, receiver);
}

}  // namespace prt::viewer
