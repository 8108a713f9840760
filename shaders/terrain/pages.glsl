// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Where the texels of a layer are that is held in tiles (src/terrain/atlas.h). A level of detail
// may have no tile at a place: then its nearest ancestor's texels stand in.

uniform highp sampler2D u_pages; // slot's column, row, level of the tile in it; steps of 1 / 255

const int PAGE_TILE = 256;
const int PAGE_BORDER = 3;
const int PAGE_SIDE = 262;

// `paging` of a layer: width and height of its finest level, first row in u_pages, rows of that
// level there plus a 32nd of its last level; 0: it is held whole.
bool page_is_used(vec4 paging)
{
    return paging.x > 0.5;
}

// Texels of a level: halves, rounded up.
ivec2 page_size(vec4 paging, int level)
{
    return (ivec2(paging.xy) + (1 << level) - 1) >> level;
}

// Where the texels of a place are: the size of the level that was found, and the corner of its tile
// in that and in the atlas.
struct Page {
    ivec2 size, corner, origin;
};

// `uv`: from 0 to 1, and less than a texel outside.
Page page_find(vec4 paging, vec2 uv, int level)
{
    int rows = int(paging.w);
    level = clamp(level, 0, int(32.0 * fract(paging.w) + 0.5));
    ivec2 size = page_size(paging, level);
    ivec2 tile = clamp(ivec2(floor(uv * vec2(size))), ivec2(0), size - 1) / PAGE_TILE;
    int row = int(paging.z) + 2 * rows - ((2 * rows) >> level) + tile.y;
    vec3 entry = floor(texelFetch(u_pages, ivec2(tile.x, row), 0).xyz * 255.0 + 0.5);
    int found = int(entry.z);
    // An ancestor has all texels of the tile, up to one of its own further on.
    ivec2 corner = (tile >> (found - level)) * PAGE_TILE;
    return Page(page_size(paging, found), corner, ivec2(entry.xy) * PAGE_SIDE + PAGE_BORDER);
}

// A place in texels of the atlas.
vec2 page_texel(vec4 paging, vec2 uv, int level)
{
    Page page = page_find(paging, uv, level);
    return uv * vec2(page.size) - vec2(page.corner) + vec2(page.origin);
}
