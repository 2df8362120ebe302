// Los textos de la propia página: marco, configuración, ganancias, figuras, tablas.

import { core } from "./core.js";

export const page = {
  titles: {
    playground: "adaptarm: control adaptativo de un brazo robótico, en vivo",
    jobs: "adaptarm: trabajos",
  },
  descriptions: {
    playground:
      "Tres controladores adaptativos en un brazo CRS A465 simulado: cambie cualquier ganancia y vea cómo responden errores, " +
      "pares y estimaciones.",
    jobs: "Simulaciones de un brazo robótico que ejecuta este servidor: su progreso y sus resultados.",
  },
  skip: "Saltar a los resultados",
  tagline: "Control adaptativo de un brazo robótico, en vivo",
  intro:
    "Tres controladores llevan el mismo brazo simulado por la misma trayectoria sin conocer sus masas ni sus fricciones: aprenden " +
    "18 parámetros por el camino. Mueva un control deslizante y todas las curvas y números se calculan de nuevo, aquí, en su " +
    "navegador. El esquema propuesto lo hace sin medir la velocidad.",
  pages: { playground: "Laboratorio", classroom: "Aula", jobs: "Trabajos", api: "API" },
  pagesLabel: "Páginas",
  toolbar: "Herramientas",
  sections: "Secciones",
  controls: "Controles",
  setup: "Ajustes",
  gains: "Ganancias",
  results: "Resultados",
  tables: "Tablas",
  language: "Idioma",
  themeDark: "Tema oscuro",
  themeLight: "Tema claro",

  study: "Estudio",
  studies: {
    paper: "El estudio del artículo",
    from_rest: "Desde el reposo",
    heavier_arm: "Brazo más pesado",
  },
  studyHelp: {
    paper: "El brazo arranca con la velocidad deseada; el brazo simulado es el nominal.",
    from_rest: "Como en el artículo, pero el brazo arranca en reposo.",
    heavier_arm: "La inercia es un 30 % y la gravedad un 50 % mayor que la nominal. Los controladores no lo saben.",
    custom: "Sus propios ajustes. Elegir un estudio los sustituye.",
  },
  studyCustom: "Propio",
  duration: "Duración",
  step: "Paso",
  friction: "Fricción",
  frictionHelp: "Velocidad en la que la fricción seca cambia de signo; 0 es el signo verdadero.",
  start: "Arranque",
  startDesired: "a la velocidad deseada",
  startRest: "en reposo",
  resetAll: "Restablecer todo",
  resetScheme: (scheme) => `Restablecer las ganancias de ${scheme}`,
  reset: (label) => `Restablecer ${label}`,
  schemes: "Esquemas de control",
  joint: (number, name) => `Articulación ${number}, ${name}`,
  scalarGains: "Adaptación y filtros",
  projection: "Cotas de la proyección",
  eighteen: (count) => `${count} valores, uno por parámetro`,
  exactly: (label) => `${label}, valor exacto`,

  show: (scheme) => `Mostrar ${scheme} en las figuras`,
  waiting: "en espera",
  running: (percent) => `calculando, ${percent} %`,
  completed: (milliseconds) => `listo en ${milliseconds} ms`,
  diverged: (time, reason) => `divergió a los ${time}: ${core.reason(reason)}`,
  divergedShort: (time) => `divergió a los ${time}`,
  failed: (message) => `falló: ${message}`,
  stop: "Parar",
  runAgain: "Calcular de nuevo",
  stoppedAt: (percent) => `parado al ${percent} %`,
  ended: "completado",
  hash: "hash",
  hashTitle: (hash) =>
    `Hash de la trayectoria ${hash}. Hashes iguales significan muestras iguales, bit a bit, en cualquier máquina. Clic para copiarlo.`,
  copied: "Hash de la trayectoria copiado.",

  stateRunning: "calculando…",
  stateReady: (milliseconds) => `al\u00a0día · ${milliseconds}\u00a0ms`,
  announceReady: (parts) => `Resultados actualizados. ${parts}`,

  pinnedFigure: "Figura fijada",

  table1: "Índice de desempeño de los errores articulares,\u00a0°",
  table2: "Índice de desempeño de los errores de velocidad articular,\u00a0°/s",
  tableOther: "Máximos y establecimiento",
  jointShort: (number) => `Art. ${number}`,
  paperValue: (value) => `artículo ${value}`,
  ratio: (ratio) => `razón ${ratio}`,
  tableNote:
    "Grande: esta simulación. Pequeño: el valor del artículo y el nuestro dividido por él. " +
    "Los valores del artículo corresponden a sus propios ajustes.",
  scheme: "Esquema",
  quantity: "Articulaciones 1, 2, 3",
  rows: {
    e_peak_deg: "Máximo de |e|,\u00a0°",
    z_peak_deg: "Máximo de |z|,\u00a0°",
    tau_peak_nm: "Máximo de |τ|,\u00a0N·m",
    voltage_peak_v: "Tensión máxima del motor,\u00a0V",
    settling_e_s: "Establecimiento de |e|,\u00a0s",
    settling_de_s: "Establecimiento de |ė|,\u00a0s",
  },
  settlingNote: (e, de) =>
    `Establecido: |e| se mantiene dentro de ${e}°, |ė| dentro de ${de}°/s. Una raya significa nunca, o que no procede.`,

  colophon: (version) =>
    `adaptarm, núcleo ${version}. Calculado en este navegador por el mismo núcleo en Rust que en el servidor; no se envía nada a ` +
    "ninguna parte.",
  moduleMissing: (reason) =>
    `El módulo de simulación no se cargó (${reason}). Si sirve esta página desde el código fuente, ejecute «cargo xtask dist» y recargue.`,
  workerRestarted: "Un proceso en segundo plano se detuvo y se reinició; su simulación empezó de nuevo.",
  workerGone: "los procesos en segundo plano se detienen una y otra vez",
  stateDropped: "Lo recordado de la última visita no se pudo usar y se sustituyó por el estudio del artículo.",
  dismiss: "Cerrar",
};
