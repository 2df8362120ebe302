// Textos: uso sin servidor y versiones nuevas de la página.

export const offline = {
  ready: "Lista para funcionar sin conexión.",
  newer: "Hay una versión nueva de esta página.",
  reload: "Recargar",
};
