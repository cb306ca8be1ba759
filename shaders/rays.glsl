// Where rays come from and where they enter the region's box. Lengths in the unit frame.

uniform vec3 region_low;
uniform vec3 region_high;
uniform vec4 cut;           // only where cut.xyz . x <= cut.w; 0, 0, 0, 1 for no cut

uniform vec3 eye;
uniform vec3 camera_right;
uniform vec3 camera_up;
uniform vec3 camera_back;
uniform vec2 half_picture;  // half its width and height, at the target for an orthographic camera, at distance 1 otherwise
uniform int orthographic;
uniform vec2 picture_size;  // pixels
uniform vec2 tile_origin;   // the pixel at the tile's lower left
uniform vec2 jitter;        // this sample's place in the pixel, 0 to 1

struct Ray {
    vec3 origin;
    vec3 direction; // of length 1
    float far;      // where it leaves the region; negative when it misses it
};

struct Sight {
    vec3 origin;
    vec3 direction;
};

Sight sight_through(vec2 pixel)
{
    vec2 at = (2.0 * pixel / picture_size - 1.0) * half_picture;
    vec3 across = at.x * camera_right + at.y * camera_up;
    if (orthographic != 0)
        return Sight(eye + across, -camera_back);
    return Sight(eye, normalize(across - camera_back));
}

// What this fragment of a tile sees.
Sight tile_sight()
{
    return sight_through(floor(gl_FragCoord.xy) + tile_origin + jitter);
}

// The part of a ray in the region and behind the cut; `enter` is how far it begins from the origin.
Ray enter_region(vec3 origin, vec3 direction, out float enter)
{
    vec3 rate = 1.0 / (mix(vec3(-1.0), vec3(1.0), greaterThanEqual(direction, vec3(0.0))) * max(abs(direction), 1e-20));
    vec3 first = (region_low - origin) * rate;
    vec3 second = (region_high - origin) * rate;
    vec3 near = min(first, second);
    vec3 far = max(first, second);
    enter = max(max(near.x, near.y), max(near.z, 0.0));
    float leave = min(far.x, min(far.y, far.z));
    float outside = dot(cut.xyz, origin) - cut.w;
    float nearing = -dot(cut.xyz, direction);
    if (nearing > 0.0)
        enter = max(enter, outside / nearing);
    else if (nearing < 0.0)
        leave = min(leave, outside / nearing);
    else if (outside > 0.0)
        leave = -1.0;
    return Ray(origin + enter * direction, direction, leave - enter);
}
