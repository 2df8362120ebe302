// Textos: las señales, las figuras que las muestran y las tres elecciones de cada esquema.

export const signals = {
  e: {
    name: "el error de seguimiento e",
    what: "Dónde está una articulación menos dónde debería estar. Todo lo que hacen los controladores busca hacerlo pequeño.",
    read: "Una curva junto a cero es buena. Su media cuadrática sobre las muestras es el índice I(e) de la tabla 1.",
  },
  q: {
    name: "la posición articular q",
    what: "El ángulo de cada articulación junto al deseado: una suma de tres senos en torno a la posición inicial.",
    read: "Las curvas coinciden salvo que algo vaya muy mal; la diferencia la muestra el error de seguimiento.",
  },
  de: {
    name: "el error de velocidad ė",
    what: "Con qué rapidez gira una articulación menos con cuál debería. Se calcula con la velocidad verdadera, también para el esquema que no la mide.",
    read: "Su media cuadrática es el índice de la tabla 2. Una articulación se da por asentada cuando |ė| queda bajo 0.5 °/s.",
  },
  z: {
    name: "el error del observador z",
    what: "La posición medida menos la posición del observador. Solo el esquema propuesto tiene observador.",
    read: "Una z pequeña no prueba que la velocidad observada sea buena: Λ_z sola puede hacerla pequeña sin tocar el movimiento.",
  },
  s: {
    name: "la variable deslizante s",
    what: "Error de velocidad y error de posición en un número. Si s queda en cero, el error de seguimiento se apaga solo, al ritmo Λ.",
    read: "El par de realimentación es −K s: esta curva, por K, es el par que los estimados no supieron dar.",
  },
  tau: {
    name: "el par τ",
    what: "Lo que el controlador pide a cada articulación: realimentación de s más lo que según los estimados necesita el movimiento.",
    read: "En una buena simulación las curvas de los tres esquemas casi coinciden: el mismo movimiento necesita el mismo par.",
  },
  voltage: {
    name: "la tensión v del motor",
    what: "El par dividido por 16.952 N·m/V: relación de engranes por constante de par entre resistencia de armadura. La fuerza contraelectromotriz se deja fuera, como en el artículo.",
    read: "El modelo del artículo deja al controlador cualquier tensión; nada se recorta.",
  },
  theta_hat: {
    name: "los estimados θ̂",
    what: "Los 18 números que el controlador cree: inercias, fricción viscosa y seca, gravedad. Empiezan en cero; la línea horizontal es la verdad.",
    read:
      "Seguir bien no exige estimados verdaderos: exige estimados cuyos pares sumen lo correcto. Un estimado lejos de su línea junto a un error pequeño muestra justo eso.",
  },
  norm: {
    name: "el error relativo de los estimados",
    what: "Qué tan lejos de la verdad están los 18 estimados juntos: la media cuadrática de sus errores relativos. Empieza en 1, pues los estimados empiezan en cero; los parámetros pequeños cuentan tanto como los grandes.",
    read: "No tiene por qué bajar: con una ley de gradiente el error de seguimiento puede desaparecer mientras este queda. Basta un estimado muy por encima de un valor verdadero pequeño para que pase de 1.",
  },
  torque_parts: {
    name: "las partes del par",
    what: "El par que el brazo verdadero necesita para su movimiento, descompuesto: inercia, Coriolis y centrífuga, fricción viscosa, fricción seca, gravedad.",
    read: "En cada instante las partes suman el par. La mayor es aquella cuyos parámetros más importan.",
  },
  phase_plane: {
    name: "el plano de fase",
    what: "Error de velocidad sobre error de seguimiento, con el tiempo a lo largo de la curva. La superficie deslizante s = 0 es una recta por el origen; su pendiente es −Λ, así que cada esquema y articulación tiene la suya, y no se dibuja ninguna.",
    read: "Por su recta una simulación se desliza al origen. Lo que la mantiene girando en vez de eso es par aún no aprendido.",
  },
  index: {
    name: "el índice de desempeño I",
    what: "Media cuadrática sobre k = 3000 muestras desde el inicio: un número por articulación para toda una curva.",
    read: "El inicio, cuando aún no se ha aprendido nada, pesa tanto como el final.",
  },
  schemes: {
    proposed: {
      velocity: "Un observador da la velocidad a partir de posiciones solas.",
      feedback: "Una variable deslizante con la velocidad observada; el par del modelo se toma a lo largo del movimiento de referencia.",
      adaptation: "Gradiente más errores de predicción recordados; una proyección mantiene los estimados dentro de cotas.",
    },
    tang_arteaga: {
      velocity: "La velocidad medida.",
      feedback: "Una variable deslizante con la velocidad medida, más el par del modelo.",
      adaptation: "Gradiente más errores de predicción recordados, sin proyección.",
    },
    slotine_li: {
      velocity: "La velocidad medida.",
      feedback: "Una variable deslizante con la velocidad medida, más el par del modelo.",
      adaptation: "El gradiente solo: un estimado se mueve únicamente mientras hay error de seguimiento.",
    },
  },
};
