// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <epoxy/gl.h>

namespace bounce::gl {

// Calls draw() and returns what a query of the kind `what` (GL_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED) counts
// meanwhile; waits for the GPU.
template <typename Draw>
GLuint count_samples(GLenum what, const Draw& draw) {
    GLuint query = 0;
    glCreateQueries(what, 1, &query);
    glBeginQuery(what, query);
    draw();
    glEndQuery(what);
    GLuint result = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &result);
    glDeleteQueries(1, &query);
    return result;
}

}  // namespace bounce::gl
