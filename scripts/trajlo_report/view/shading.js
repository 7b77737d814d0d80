// SPDX-License-Identifier: MIT
// Points have no surface to shade; edges where the depth jumps make their shapes visible
// (eye-dome lighting: C. Boucheny, 2009).

const SHADE_VERTEX = `
  varying vec2 at;
  void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }`;
const SHADE_FRAGMENT = `
  uniform sampler2D colors;
  uniform sampler2D depths;
  uniform vec2 pixel;
  uniform vec2 range;      // near and far, m
  uniform float strength;
  varying vec2 at;
  float logDepth(vec2 where) {
    float d = texture2D(depths, where).x;
    return log2(range.x * range.y / (range.y - d * (range.y - range.x)));
  }
  void main() {
    float d = texture2D(depths, at).x;
    if (d >= 1.0) discard;
    float own = logDepth(at);
    float nearer = 0.0;
    for (int i = 0; i < 8; ++i) {
      float angle = 0.785398 * float(i);
      nearer += max(0.0, own - logDepth(at + pixel * vec2(cos(angle), sin(angle))));
    }
    vec3 color = texture2D(colors, at).rgb;
    gl_FragColor = vec4(color * max(exp(-strength * nearer / 8.0), 0.25), 1.0);
    gl_FragDepthEXT = d;
  }`;

class Shading {
  constructor(renderer) {
    this.renderer = renderer;
    this.target = new THREE.WebGLRenderTarget(1, 1, {
      minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, stencilBuffer: false });
    this.target.depthTexture = new THREE.DepthTexture(1, 1, THREE.UnsignedIntType);
    this.material = new THREE.ShaderMaterial({
      vertexShader: SHADE_VERTEX, fragmentShader: SHADE_FRAGMENT,
      extensions: { fragDepth: true },
      uniforms: { colors: { value: this.target.texture },
                  depths: { value: this.target.depthTexture },
                  pixel: { value: new THREE.Vector2() }, range: { value: new THREE.Vector2() },
                  strength: { value: 9 } },
    });
    this.quad = new THREE.Mesh(new THREE.PlaneBufferGeometry(2, 2), this.material);
    this.quad.frustumCulled = false;
    this.scene = new THREE.Scene();
    this.scene.add(this.quad);
    this.camera = new THREE.Camera();
  }

  setSize(width, height, ratio) {
    this.target.setSize(Math.round(width * ratio), Math.round(height * ratio));
    this.material.uniforms.pixel.value.set(1.2 / width, 1.2 / height);
  }

  // Draws `scene` with shades, leaving its depths for what is drawn next.
  render(scene, camera) {
    this.material.uniforms.range.value.set(camera.near, camera.far);
    this.renderer.setRenderTarget(this.target);
    this.renderer.clear();
    this.renderer.render(scene, camera);
    this.renderer.setRenderTarget(null);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
  }
}
