#version 330 core
// Nothing to shade: the shadow map has depth and no colour.

void main() {}
