// SPDX-License-Identifier: Apache-2.0
#include "gl/framebuffer.h"

#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "gl/label.h"

namespace bounce::gl {

Framebuffer::Framebuffer(const std::string& name, std::initializer_list<Attachment> colors,
                         Attachment depth) {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    object_ = Object<delete_framebuffer>(id);
    const auto attach = [&](GLenum point, const Attachment& attachment) {
        if (attachment.layer >= 0) {
            glNamedFramebufferTextureLayer(id, point, attachment.texture->id(), 0, attachment.layer);
        } else {
            glNamedFramebufferTexture(id, point, attachment.texture->id(), 0);
        }
        width_ = attachment.texture->desc().width;
        height_ = attachment.texture->desc().height;
    };
    std::vector<GLenum> points;
    for (const Attachment& color : colors) {
        points.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(points.size()));
        attach(points.back(), color);
    }
    if (depth.texture != nullptr) {
        attach(GL_DEPTH_ATTACHMENT, depth);
    }
    if (points.empty()) {
        glNamedFramebufferDrawBuffer(id, GL_NONE);
        glNamedFramebufferReadBuffer(id, GL_NONE);
    } else {
        glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(points.size()), points.data());
    }
    set_label(GL_FRAMEBUFFER, id, name);
    const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        throw Error(ExitCode::failed,
                    fmt::format("this OpenGL driver cannot draw to the targets of {} (status 0x{:04x})", name,
                                status));
    }
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, id());
    glViewport(0, 0, width_, height_);
}

}  // namespace bounce::gl
