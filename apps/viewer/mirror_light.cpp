#include "apps/viewer/mirror_light.h"

#include <chrono>

namespace prt::viewer {

void MirrorLight::begin(const std::shared_ptr<const Environment>& environment) {
    if (environment == made_) return;
    made_ = environment;
    making_ = std::async(std::launch::async,
                         [environment] { return makeMirrorEnvironment(*environment); });
}

void MirrorLight::takeOver() {
    mirrors_.reset();  // before there are two
    mirrors_.emplace(making_.get());
    ++revision_;
}

void MirrorLight::update(const std::shared_ptr<const Environment>& environment) {
    if (making_.valid() && making_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        takeOver();
    if (!making_.valid()) begin(environment);
}

void MirrorLight::finish(const std::shared_ptr<const Environment>& environment) {
    if (making_.valid()) takeOver();
    begin(environment);
    if (making_.valid()) takeOver();
}

}  // namespace prt::viewer
